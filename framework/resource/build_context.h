// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "resource/entry.h"
#include "resource/value.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <typeindex>
#include <unordered_map>

namespace terrane {

class RandomAccessFile;
class ResourceManager;
class Registry;

/// Objects that the host gives to builders, by type: the GL context, shared pools.
class Services {
public:
    template <class S>
    void provide(S& service) {
        table_[std::type_index(typeid(S))] = &service;
    }
    /// Null when the host has none.
    template <class S>
    S* find() const {
        const auto found = table_.find(std::type_index(typeid(S)));
        return found == table_.end() ? nullptr : static_cast<S*>(found->second);
    }

private:
    std::unordered_map<std::type_index, void*> table_;
};

/// What a builder may use while it makes one resource. Everything it loads or reads becomes a
/// recorded dependency of that resource.
class BuildContext {
public:
    BuildContext(ResourceManager& manager, ResourceEntry& entry, Diagnostics& diagnostics)
        : manager_(manager)
        , entry_(entry)
        , diagnostics_(diagnostics) {}

    /// Name of the (outermost) resource that is being built.
    const std::string& name() const { return entry_.name; }
    /// Reports here get the chain of resources being loaded.
    Diagnostics& diagnostics() const { return diagnostics_; }
    ResourceManager& manager() const { return manager_; }
    ResourceEntry& entry() const { return entry_; }
    /// In a reload: the version that the resource being built replaces, if it is a T; else null.
    template <class T>
    std::shared_ptr<T> previous() const {
        return std::dynamic_pointer_cast<T>(previous_);
    }

    /// A service that the host must have provided.
    template <class S>
    S& service() const;

    /// Loads an onDemand reference now; null (already reported) when it can't be had.
    template <class T>
    T* load(const Ref<T>& ref) const {
        loadReference(ref, typeid(T));
        return ref.get();
    }
    /// Loads a resource by a name that no attribute holds.
    template <class T>
    Ref<T> load(const std::string& name, const Place& place) const {
        Ref<T> ref(name);
        ref.place = place;
        loadReference(ref, typeid(T));
        return ref;
    }

    /// Finds a data file in the search folders and records it; reports when it is missing.
    /// @param significant what counts of it; see FileStamp
    std::optional<std::filesystem::path>
    findFile(const std::string& name, const Place& place,
             FileStamp::Significant significant = nullptr) const;
    /// Records that there is no file of a name: as soon as there is one, the resource is made anew.
    void addMissingFile(const std::string& name) const;
    /// Records a data file that was found otherwise, to be called before it is read.
    void addFile(const std::string& name, const std::filesystem::path& path,
                 FileStamp::Significant significant = nullptr) const;
    /// Finds, records and reads a file; reports when it is missing or can't be read.
    std::optional<std::string> readFile(const std::string& name, const Place& place) const;
    /// The same, to be read in pieces; null when it can't be.
    std::unique_ptr<RandomAccessFile> openFile(const std::string& name, const Place& place) const;
    /// The same as readFile(), as text that diagnostics can point into; null when it can't be.
    std::shared_ptr<const SourceFile>
    readSource(const std::string& name, const Place& place,
               FileStamp::Significant significant = nullptr) const;

private:
    friend class ResourceManager;

    const FileTree& files() const;
    void reportUnreadable(const std::string& name, const Place& place,
                          const std::string& problem) const;
    void loadReference(const RefBase& ref, std::type_index interface) const;

    ResourceManager& manager_;
    ResourceEntry& entry_;
    Diagnostics& diagnostics_;
    std::shared_ptr<Resource> previous_;
    mutable int uses_ = 0; ///< of files and resources that no attribute names
};

} // namespace terrane
