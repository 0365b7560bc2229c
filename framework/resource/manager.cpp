// SPDX-License-Identifier: BSD-3-Clause
#include "resource/manager.h"

#include "core/text.h"
#include "resource/predecessors.h"
#include "resource/prepared_data.h"
#include "resource/transaction.h"

#include <algorithm>
#include <new>
#include <set>

namespace terrane {

namespace {

// A broken archive can chain as many names as it likes; the stack can't.
constexpr std::size_t kMaxChain = 500;

// The modules of a program "a;b;" are blamed on their pieces of the name.
void blamePieces(ElementDescription& description, const ElementDeclaration& declaration,
                 const std::string& name, const Place& place) {
    const std::string& text = place.file->text();
    const bool spelled =
        std::string_view(text).substr(std::min(place.offset, text.size())).starts_with(name);
    if (!spelled) return;
    std::size_t offset = 0;
    for (const auto& [attribute, ref] : references(declaration, description, false)) {
        ref->place.offset = place.offset + offset;
        offset += ref->name.size() + 1;
    }
}

// Lets go of what was built for a resource that could not be.
void dropChildren(ElementDescription& description) {
    for (Child& child : description.children) {
        child.resource.reset();
        dropChildren(*child.description);
    }
}

bool isReady(const RefBase& ref) {
    return ref.entry() && ref.entry()->state == ResourceEntry::State::ready;
}

bool contains(const std::vector<ResourceEntry*>& list, const ResourceEntry& entry) {
    return std::find(list.begin(), list.end(), &entry) != list.end();
}

// The shorter list tells, since a scene may name all nodes, and all nodes a mesh.
bool isConnected(const ResourceEntry& dependent, const ResourceEntry& entry) {
    return dependent.dependencies.size() < entry.dependents.size()
               ? contains(dependent.dependencies, entry)
               : contains(entry.dependents, dependent);
}

// Whether all that keeps a resource from being built is data that a script has yet to prepare.
bool lacksOnlyData(const Diagnostics& building) {
    const std::vector<Diagnostic> all = building.all();
    return building.errors() == 0 && std::any_of(all.begin(), all.end(), [](const Diagnostic& d) {
               return d.code == kDataNotPrepared;
           });
}

// Whether an element can be built: what it names is there, but for what is not built yet and can be
// done without.
bool canBuild(const ElementDeclaration& declaration, ElementDescription& description) {
    for (const AttributeDeclaration& a : declaration.attributes) {
        if (!a.references || a.onDemand) continue;
        std::vector<RefBase*> list;
        a.references(description, list);
        for (const RefBase* ref : list) {
            const bool planned =
                ref->entry() && ref->entry()->state == ResourceEntry::State::planned;
            if (ref->given() && !isReady(*ref) && !(planned && !a.required)) return false;
        }
    }
    return true;
}

} // namespace

ResourceManager::ResourceManager(const Registry& registry, Library& library,
                                 Diagnostics& diagnostics)
    : registry_(registry)
    , library_(&library)
    , diagnostics_(diagnostics) {}

ResourceManager::~ResourceManager() {
    std::vector<ResourceEntry*> order;
    for (const auto& [name, entry] : entries_)
        order.push_back(entry.get());
    std::sort(order.begin(), order.end(),
              [](const auto* a, const auto* b) { return a->order > b->order; });
    for (ResourceEntry* const entry : order) {
        entry->instance.reset();
        entry->description.reset();
    }
}

ResourceEntry* ResourceManager::load(const std::string& name, const Place& place) {
    const auto known = entries_.find(name);
    if (known != entries_.end() && known->second->state != ResourceEntry::State::unloaded) {
        ResourceEntry& entry = *known->second;
        if (entry.state == ResourceEntry::State::loading) {
            reportCycle(entry, place);
            return nullptr;
        }
        return &entry;
    }
    if (loading_.size() > kMaxChain) {
        diagnostics_.report({.code = "too-deep",
                             .place = place,
                             .message = "resources refer to one another too deeply",
                             .expected = "at most " + std::to_string(kMaxChain) + " in a row"});
        return nullptr;
    }
    const auto found = library_->find(name);
    if (!found && library_->isDamaged(name)) {
        // The damage has been told; whoever else names it fails silently.
        ResourceEntry& entry = add(name);
        entry.state = ResourceEntry::State::failed;
        return &entry;
    }
    if (!found) {
        reportUnknown(name, place);
        return nullptr;
    }
    ResourceEntry& entry = add(name);
    entry.state = ResourceEntry::State::loading;
    entry.descriptor = found->file;
    entry.fingerprint = found->element.fingerprint();
    loading_.push_back({&entry, place});
    warnName(name, *found, place);
    describeAndBuild(entry, *found, place);
    loading_.pop_back();
    return &entry;
}

ResourceEntry& ResourceManager::add(const std::string& name) {
    const auto [known, isNew] = entries_.try_emplace(name);
    if (isNew) {
        known->second = std::make_unique<ResourceEntry>();
        known->second->name = name;
        if (transaction_) transaction_->added.push_back(known->second.get());
    }
    return *known->second;
}

const ElementDeclaration* ResourceManager::declarationOf(const XmlElement& element) {
    const std::string tag = element.tag();
    if (const ElementDeclaration* declaration = registry_.find(tag)) return declaration;
    diagnostics_.report({.code = "unknown-element",
                         .place = element.place(),
                         .message = "there is no resource type " + inQuotes(tag),
                         .suggestion = nearestName(tag, registry_.entryTags()),
                         .chain = chain()});
    return nullptr;
}

void ResourceManager::describeAndBuild(ResourceEntry& entry, const FoundElement& found,
                                       const Place& place) {
    entry.state = ResourceEntry::State::failed;
    entry.declaration = declarationOf(found.element);
    if (!entry.declaration) return;

    Diagnostics local;
    const bool blame = found.synthesised && place;
    const XmlElement element = blame ? found.element.blamedOn(place) : found.element;
    ParsedElement parsed = parseElement(element, *entry.declaration, registry_, local);
    entry.description = parsed.description;
    if (blame && entry.name.find(';') != std::string::npos)
        blamePieces(*entry.description, *entry.declaration, entry.name, place);
    forward(local);

    // References are followed even from an invalid description, so that one run tells all.
    entry.state = ResourceEntry::State::loading;
    const bool complete = loadReferences(entry, false);
    const bool lacksPlanned = complete && !canBuild(*entry.declaration, *entry.description);
    const bool planned = entry.declaration->planned || lacksPlanned;
    entry.state = planned ? ResourceEntry::State::planned : ResourceEntry::State::failed;
    // Its builder won't run, and so can't tell which files are missing.
    if (!parsed.valid || !complete) findFiles(parsed.files);
    if (!parsed.valid || !complete || planned) return;

    Diagnostics building;
    build(entry, building);
    forward(building);
}

void ResourceManager::findFiles(const std::vector<AttributeText>& files) {
    Diagnostics local;
    for (const AttributeText& file : files)
        filesNotRead_[file.text] =
            library_->findFile(file.text, file.valuePlace, local).value_or("");
    forward(local);
}

// False if a reference of the element itself could not be had. One that a nested element lacks
// only costs that element: the rest is still built. References to what is not built yet are no
// failure either.
bool ResourceManager::loadReferences(ResourceEntry& entry, bool onDemand) {
    std::vector<RefBase*> list;
    for (const AttributeDeclaration& a : entry.declaration->attributes) {
        if (a.references) a.references(*entry.description, list);
    }
    const std::set<const RefBase*> own(list.begin(), list.end());
    bool complete = true;
    for (const auto& [attribute, ref] :
         references(*entry.declaration, *entry.description, onDemand)) {
        resolve(*ref, *attribute->refersTo, &entry, attribute->live);
        const bool planned = ref->entry() && ref->entry()->state == ResourceEntry::State::planned;
        if (isReady(*ref) || planned) continue;
        entry.incomplete = true;
        if (own.contains(ref)) complete = false;
    }
    return complete;
}

void ResourceManager::build(ResourceEntry& entry, Diagnostics& local) {
    BuildContext context(*this, entry, local);
    entry.state = ResourceEntry::State::loading;
    try {
        const ResourceVersion* const previous =
            transaction_ ? transaction_->previous(&entry) : nullptr;
        buildChildren(*entry.description, context,
                      previous ? previous->description.get() : nullptr);
        context.previous_ = previous ? previous->instance : nullptr;
        if (entry.declaration->build)
            entry.instance = entry.declaration->build(*entry.description, context);
    } catch (const std::bad_alloc&) {
        local.error("out-of-memory", entry.description->place,
                    "there is not enough memory for " + described(entry));
    }
    entry.state = entry.instance ? ResourceEntry::State::ready : ResourceEntry::State::failed;
    if (!entry.instance && lacksOnlyData(local)) entry.state = ResourceEntry::State::planned;
    entry.order = ++built_;
    if (!entry.instance) dropChildren(*entry.description);
}

void ResourceManager::buildChildren(ElementDescription& description, BuildContext& context,
                                    const ElementDescription* previous) {
    const std::vector<const Child*> before = predecessors(previous, description);
    for (std::size_t i = 0; i < description.children.size(); ++i) {
        Child& child = description.children[i];
        if (before[i] && isKept(*before[i], child)) {
            // Its description comes along, with what stands in it.
            child = *before[i];
            continue;
        }
        const int uses = context.uses_;
        buildChildren(*child.description, context,
                      before[i] ? before[i]->description.get() : nullptr);
        if (!child.declaration->build || !canBuild(*child.declaration, *child.description))
            continue;
        context.previous_ = before[i] ? before[i]->resource : nullptr;
        child.resource = child.declaration->build(*child.description, context);
        child.selfContained = context.uses_ == uses;
        if (!child.resource) context.entry_.incomplete = true;
    }
}

// Whether a nested resource of the version before the reload serves for the element of now.
bool ResourceManager::isKept(const Child& previous, const Child& child) const {
    if (!previous.resource || !previous.selfContained ||
        previous.description->fingerprint != child.description->fingerprint)
        return false;
    for (const bool onDemand : {false, true}) {
        for (const auto& [attribute, ref] :
             references(*child.declaration, *child.description, onDemand)) {
            if (!isReady(*ref)) return false;
            if (!attribute->live && transaction_->touches(ref->entry())) return false;
        }
    }
    return true;
}

void ResourceManager::connect(ResourceEntry& dependent, ResourceEntry& entry, bool live) {
    const bool isNew = !isConnected(dependent, entry);
    if (isNew) {
        dependent.dependencies.push_back(&entry);
        entry.dependents.push_back(&dependent);
    }
    if (!live && (isNew || !contains(dependent.madeFrom, entry)))
        dependent.madeFrom.push_back(&entry);
}

void ResourceManager::resolve(const RefBase& ref, std::type_index interface,
                              ResourceEntry* dependent, bool live) {
    ResourceEntry* const entry = load(ref.name, ref.place);
    if (!entry) return;
    if (dependent) connect(*dependent, *entry, live);
    if (!entry->declaration) return;
    if (!entry->declaration->isA(interface) && !entry->declaration->planned) {
        reportMistyped(ref, *entry, interface);
        return;
    }
    ref.resolve(entry);
}

void ResourceManager::loadAll() {
    for (const XmlElement& element : library_->entries()) {
        const std::string name = element.attribute("name");
        if (registry_.findTopLevel(element.tag())) continue;
        const auto found = library_->find(name);
        if (!found || !(found->element == element)) {
            checkUnused(element);
            continue;
        }
        ResourceEntry* const entry = load(name, {});
        if (entry && entry->description) loadReferences(*entry, true);
    }
}

// An entry that no name leads to. Its mistakes are told all the same: often one is in its name.
void ResourceManager::checkUnused(const XmlElement& element) {
    const ElementDeclaration* const declaration = declarationOf(element);
    if (!declaration) return;
    if (element.attribute("name").empty()) {
        diagnostics_.warning("unnamed-entry", element.place(),
                             asTag(element.tag()) + " without a name is never used",
                             "an attribute 'name'");
    }
    findFiles(parseElement(element, *declaration, registry_, diagnostics_).files);
}

} // namespace terrane
