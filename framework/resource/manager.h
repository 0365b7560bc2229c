// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "resource/build_context.h"
#include "resource/entry.h"
#include "resource/library.h"
#include "resource/parser.h"
#include "resource/registry.h"

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace terrane {

struct Transaction;

/// Loads resources by name, keeps at most one instance per name, and knows what depends on what.
/// Owns all entries and instances; destroys instances in the reverse order of their creation, so
/// that a dependent goes before what it uses. Lives on the GL thread. A Reload replaces what
/// changed.
class ResourceManager {
public:
    /// All of them must outlive the manager.
    ResourceManager(const Registry& registry, Library& library, Diagnostics& diagnostics);
    ~ResourceManager();

    Services& services() { return services_; }
    const Registry& registry() const { return registry_; }
    Library& library() { return *library_; }
    Diagnostics& diagnostics() { return diagnostics_; }

    /// Loads a resource and everything it refers to. The entry's state tells what came of it;
    /// problems are reported once. Null when there is no such name (reported at `place`).
    ResourceEntry* load(const std::string& name, const Place& place);

    /// Loads what a reference names, checks that it is an `interface`, and records that
    /// `dependent` (may be null) depends on it. The reference stays unresolved after an error.
    /// @param live whether it follows the reference, and so need not be made anew with it
    void resolve(const RefBase& ref, std::type_index interface, ResourceEntry* dependent,
                 bool live = false);

    /// A typed look-up: null when it can't be had (reported).
    template <class T>
    Ref<T> get(const std::string& name, const Place& place = {},
               ResourceEntry* dependent = nullptr) {
        Ref<T> ref(name);
        ref.place = place;
        resolve(ref, typeid(T), dependent);
        return ref;
    }

    /// Loads every entry of the archives, used or not, with what is referred to on demand.
    void loadAll();

    /// Loaded and failed entries by name.
    const std::map<std::string, std::unique_ptr<ResourceEntry>>& entries() const {
        return entries_;
    }

    /// Files that elements name that could not be built, or that nothing uses: by their names,
    /// where they were found; empty paths where they were not.
    const std::map<std::string, std::filesystem::path>& filesNotRead() const {
        return filesNotRead_;
    }

private:
    friend class Reload;

    /// Builds the resources nested in a description, depth first, or keeps those of its previous
    /// version that nothing has changed for. One that can't be built is null: its parent does
    /// without it.
    void buildChildren(ElementDescription& description, BuildContext& context,
                       const ElementDescription* previous);
    bool isKept(const Child& previous, const Child& child) const;
    void connect(ResourceEntry& dependent, ResourceEntry& entry, bool live);
    ResourceEntry& add(const std::string& name);
    void warnName(const std::string& name, const FoundElement& found, const Place& place);
    void describeAndBuild(ResourceEntry& entry, const FoundElement& found, const Place& place);
    void findFiles(const std::vector<AttributeText>& files);
    void checkUnused(const XmlElement& element);
    bool loadReferences(ResourceEntry& entry, bool onDemand);
    void build(ResourceEntry& entry, Diagnostics& local);
    static std::string described(const ResourceEntry& entry); ///< "node 'scene'"
    void reportUnknown(const std::string& name, const Place& place);
    void reportCycle(const ResourceEntry& entry, const Place& place);
    void reportMistyped(const RefBase& ref, const ResourceEntry& entry, std::type_index interface);
    std::string suggestName(const std::string& name);
    std::string suggestEntry(const std::string& name, std::type_index interface);
    std::vector<std::string> chain() const;
    void forward(const Diagnostics& local);
    const ElementDeclaration* declarationOf(const XmlElement& element);

    const Registry& registry_;
    Library* library_; ///< another one after a reload
    Diagnostics& diagnostics_;
    Services services_;
    std::map<std::string, std::unique_ptr<ResourceEntry>> entries_;
    std::map<std::string, std::filesystem::path> filesNotRead_;
    std::uint64_t built_ = 0;            ///< so many instances were made
    Transaction* transaction_ = nullptr; ///< of the reload that is under way
    /// A search for the nearest name looks at every entry; an archive with more wrong names than
    /// this has another problem.
    static constexpr int kMostSuggestions = 100;
    int suggestionsLeft_ = kMostSuggestions;
    struct Loading {
        ResourceEntry* entry;
        Place neededAt;
    };
    std::vector<Loading> loading_; ///< outermost first
};

template <class S>
S& BuildContext::service() const {
    S* const found = manager_.services().find<S>();
    if (!found)
        throw std::logic_error(std::string("BuildContext::service(): the host provides no ") +
                               typeid(S).name());
    return *found;
}

} // namespace terrane
