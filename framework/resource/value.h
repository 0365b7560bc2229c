// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/source.h"
#include "resource/resource.h"

#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>
#include <typeindex>
#include <vector>

namespace terrane {

struct ResourceEntry;

/// The value of an attribute, with the place it was written at. The initial value of the member in
/// the description is the attribute's default.
template <class T>
class Attr {
public:
    Attr() = default;
    Attr(T byDefault) // implicit: `Attr<int> gridSize = 24;`
        : value(std::move(byDefault)) {}
    template <class U>
    requires(std::is_convertible_v<U, T> && !std::is_same_v<std::decay_t<U>, Attr> &&
             !std::is_same_v<std::decay_t<U>, T>) Attr(U&& byDefault)
        : value(std::forward<U>(byDefault)) {}

    operator const T&() const { return value; }
    const T& operator*() const { return value; }
    const T* operator->() const { return &value; }

    T value{};
    Place place;        ///< first character of the value; the element's '<' when it is not given
    bool given = false; ///< written by the author
};

/// A qualified name as methods use it: "this.terrain", "$o.material", "camera.draw", or a plain
/// resource name (ork reference 3). Split at the first dot.
struct Target {
    std::string node; ///< "this", "$v" or a flag; empty for a plain resource name
    std::string name;
};

/// A data file named in an archive; `path` is filled in when the search folders have it.
struct DataFile {
    std::string name;
    std::filesystem::path path;
};

/// A reference to a resource by name; resolved by the manager before the builder of the element
/// that holds it runs (unless declared onDemand), with a recorded dependency edge. It points to the
/// manager's entry, not to the instance, so a reload swaps what it gives.
class RefBase {
public:
    RefBase() = default;
    explicit RefBase(std::string byDefault)
        : name(std::move(byDefault)) {}

    bool given() const { return !name.empty(); } ///< there is a name to resolve
    ResourceEntry* entry() const { return entry_; }
    void resolve(ResourceEntry* entry) const { entry_ = entry; }

    std::string name;
    Place place; ///< first character of the name; the element's '<' for a default

protected:
    Resource* instance() const; // null until resolved
    std::shared_ptr<Resource> sharedInstance() const;

private:
    mutable ResourceEntry* entry_ = nullptr; // resolving is not a change of what was described
};

/// A reference to a resource that is, or derives from, T.
template <class T>
class Ref : public RefBase {
public:
    using RefBase::RefBase;

    T* get() const { return static_cast<T*>(instance()); }
    /// To keep the instance of now alive, across reloads too.
    std::shared_ptr<T> shared() const { return std::static_pointer_cast<T>(sharedInstance()); }
    T& operator*() const { return *get(); }
    T* operator->() const { return get(); }
    explicit operator bool() const { return get() != nullptr; }
};

/// Comma separated names of resources; empty pieces are ignored.
template <class T>
using RefList = std::vector<Ref<T>>;

} // namespace terrane
