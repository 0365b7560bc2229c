// SPDX-License-Identifier: BSD-3-Clause
#include "resource/manager.h"

#include "core/text.h"

#include <algorithm>

namespace terrane {

namespace {

// A broken archive can chain as many names as it likes; the stack can't.
constexpr std::size_t kMaxChain = 500;

std::string describe(const ResourceEntry& entry) {
    const std::string tag = entry.declaration ? entry.declaration->tag : "resource";
    return tag + " '" + entry.name + "'";
}

// A description made from a name alone has no file of its own: it is blamed on whoever named it.
// The modules of a program "a;b;" are blamed on their pieces of the name.
void blame(ElementDescription& description, const ElementDeclaration& declaration,
           const std::string& name, const Place& place) {
    description.place = place;
    const bool spelled = place.file->text().compare(place.offset, name.size(), name) == 0;
    std::size_t offset = 0;
    for (const bool onDemand : {false, true}) {
        for (const auto& [attribute, ref] : references(declaration, description, onDemand)) {
            ref->place = {place.file, place.offset + (spelled ? offset : 0)};
            offset += ref->name.size() + 1;
        }
    }
    for (const Child& child : description.children)
        child.description->place = place;
}

bool isReady(const RefBase& ref) {
    return ref.entry() && ref.entry()->state == ResourceEntry::State::ready;
}

// Whether an element can be built: what it names is there, but for what is not built yet and can be
// done without.
bool canBuild(const ElementDeclaration& declaration, ElementDescription& description) {
    for (const AttributeDeclaration& a : declaration.attributes) {
        if (!a.references || a.onDemand) continue;
        std::vector<RefBase*> list;
        a.references(description, list);
        for (const RefBase* ref : list) {
            const bool planned = ref->entry() && ref->entry()->state == ResourceEntry::State::planned;
            if (ref->given() && !isReady(*ref) && !(planned && !a.required)) return false;
        }
    }
    return true;
}

} // namespace

ResourceManager::ResourceManager(const Registry& registry, Library& library,
                                 Diagnostics& diagnostics)
    : registry_(registry)
    , library_(library)
    , diagnostics_(diagnostics) {}

ResourceManager::~ResourceManager() {
    for (auto entry = built_.rbegin(); entry != built_.rend(); ++entry) {
        (*entry)->instance.reset();
        (*entry)->description.reset();
    }
}

ResourceEntry* ResourceManager::load(const std::string& name, const Place& place) {
    const auto known = entries_.find(name);
    if (known != entries_.end()) {
        ResourceEntry& entry = *known->second;
        if (entry.state == ResourceEntry::State::loading) {
            reportCycle(entry, place);
            return nullptr;
        }
        return &entry;
    }
    if (loading_.size() > kMaxChain) {
        diagnostics_.error("too-deep", place, "resources refer to one another too deeply");
        return nullptr;
    }
    const std::size_t before = diagnostics_.errors();
    const auto found = library_.find(name);
    if (!found) {
        // A file that was found but can't be parsed has been told already.
        if (diagnostics_.errors() == before) reportUnknown(name, place);
        return nullptr;
    }
    ResourceEntry& entry = *entries_.emplace(name, std::make_unique<ResourceEntry>()).first->second;
    entry.name = name;
    entry.state = ResourceEntry::State::loading;
    if (!found->file.empty()) entry.files.push_back(found->file);
    loading_.push_back({&entry, place});
    describeAndBuild(entry, *found, place);
    loading_.pop_back();
    return &entry;
}

const ElementDeclaration* ResourceManager::declarationOf(const XmlElement& element) {
    const std::string tag = element.tag();
    if (const ElementDeclaration* declaration = registry_.find(tag)) return declaration;
    diagnostics_.report({.code = "unknown-element",
                         .place = element.place(),
                         .message = "there is no resource type <" + tag + ">",
                         .suggestion = nearestName(tag, registry_.tags()),
                         .chain = chain()});
    return nullptr;
}

void ResourceManager::describeAndBuild(ResourceEntry& entry, const FoundElement& found,
                                       const Place& place) {
    entry.state = ResourceEntry::State::failed;
    entry.declaration = declarationOf(found.element);
    if (!entry.declaration) return;

    Diagnostics local;
    ParsedElement parsed = parseElement(found.element, *entry.declaration, registry_, local);
    entry.description = parsed.description;
    if (found.synthesised && place)
        blame(*entry.description, *entry.declaration, entry.name, place);
    forward(local);

    // References are followed even from an invalid description, so that one run tells all.
    entry.state = ResourceEntry::State::loading;
    const bool complete = loadReferences(entry, false);
    const bool lacksPlanned = complete && !canBuild(*entry.declaration, *entry.description);
    const bool planned = entry.declaration->planned || lacksPlanned;
    entry.state = planned ? ResourceEntry::State::planned : ResourceEntry::State::failed;
    if (!parsed.valid || !complete || planned) return;

    Diagnostics building;
    build(entry, building);
    forward(building);
}

// False if a reference of the element itself could not be had. One that a nested element lacks
// only costs that element: the rest is still built. References to what is not built yet are no
// failure either.
bool ResourceManager::loadReferences(ResourceEntry& entry, bool onDemand) {
    std::vector<RefBase*> own;
    for (const AttributeDeclaration& a : entry.declaration->attributes) {
        if (a.references) a.references(*entry.description, own);
    }
    bool complete = true;
    for (const auto& [attribute, ref] :
         references(*entry.declaration, *entry.description, onDemand)) {
        resolve(*ref, *attribute->refersTo, &entry);
        const bool planned = ref->entry() && ref->entry()->state == ResourceEntry::State::planned;
        const bool nested = std::find(own.begin(), own.end(), ref) == own.end();
        if (!isReady(*ref) && !planned && !nested) complete = false;
    }
    return complete;
}

void ResourceManager::build(ResourceEntry& entry, Diagnostics& local) {
    BuildContext context(*this, entry, local);
    entry.state = ResourceEntry::State::loading;
    buildChildren(*entry.description, context);
    if (entry.declaration->build)
        entry.instance = entry.declaration->build(*entry.description, context);
    entry.state = entry.instance ? ResourceEntry::State::ready : ResourceEntry::State::failed;
    if (!entry.instance) return;
    built_.push_back(&entry);
}

void ResourceManager::buildChildren(ElementDescription& description, BuildContext& context) {
    for (Child& child : description.children) {
        buildChildren(*child.description, context);
        if (child.declaration->build && canBuild(*child.declaration, *child.description))
            child.resource = child.declaration->build(*child.description, context);
    }
}

void ResourceManager::resolve(const RefBase& ref, std::type_index interface,
                              ResourceEntry* dependent) {
    ResourceEntry* const entry = load(ref.name, ref.place);
    if (!entry) return;
    if (dependent) {
        dependent->dependencies.push_back(entry);
        entry->dependents.push_back(dependent);
    }
    if (!entry->declaration) return;
    if (!entry->declaration->isA(interface) && !entry->declaration->planned) {
        reportMistyped(ref, *entry, interface);
        return;
    }
    ref.resolve(entry);
}

void ResourceManager::loadAll() {
    for (const XmlElement& element : library_.entries()) {
        const std::string name = element.attribute("name");
        if (registry_.findTopLevel(element.tag())) continue;
        if (name.empty()) {
            if (declarationOf(element)) {
                diagnostics_.warning("unnamed-entry", element.place(),
                                     "<" + element.tag() + "> without a name is never used",
                                     "an attribute 'name'");
            }
            continue;
        }
        ResourceEntry* const entry = load(name, element.place());
        if (entry && entry->description) loadReferences(*entry, true);
    }
}

void ResourceManager::reportUnknown(const std::string& name, const Place& place) {
    std::vector<std::string> names = library_.names();
    for (const std::string& file : library_.searchPath().namesNear(name)) {
        if (file.ends_with(".xml")) names.push_back(file.substr(0, file.size() - 4));
    }
    diagnostics_.report({.code = "unknown-resource",
                         .place = place,
                         .message = "there is no resource '" + name + "'",
                         .expected = "an entry of the archive, or a file '" + name + ".xml'",
                         .suggestion = nearestName(name, names),
                         .chain = chain()});
}

void ResourceManager::reportCycle(const ResourceEntry& entry, const Place& place) {
    diagnostics_.report({.code = "cycle",
                         .place = place,
                         .message = describe(entry) + " needs itself",
                         .chain = chain()});
}

void ResourceManager::reportMistyped(const RefBase& ref, const ResourceEntry& entry,
                                     std::type_index interface) {
    diagnostics_.report({.code = "mistyped-reference",
                         .place = ref.place,
                         .message = "'" + ref.name + "' is a " + entry.declaration->tag,
                         .expected = registry_.describeInterface(interface),
                         .chain = chain()});
}

std::vector<std::string> ResourceManager::chain() const {
    std::vector<std::string> links;
    for (auto loading = loading_.rbegin(); loading != loading_.rend(); ++loading) {
        std::string link = describe(*loading->entry);
        if (loading->neededAt) link += ", named at " + loading->neededAt.toString();
        links.push_back(std::move(link));
    }
    return links;
}

void ResourceManager::forward(const Diagnostics& local) {
    for (Diagnostic& diagnostic : local.all()) {
        if (diagnostic.chain.empty()) diagnostic.chain = chain();
        diagnostics_.report(std::move(diagnostic));
    }
}

} // namespace terrane
