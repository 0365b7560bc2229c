// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/value.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace terrane {

struct ElementDeclaration;
struct ElementDescription;

/// A nested element: its typed description and, when it is a resource of its own, what was built
/// from it (before the parent's builder runs).
struct Child {
    const ElementDeclaration* declaration = nullptr;
    std::shared_ptr<ElementDescription> description;
    std::shared_ptr<Resource> resource;
    /// What was built depends on nothing but the description and its references: a reload that
    /// changes none of them keeps it.
    bool selfContained = false;

    /// The description, if this child was declared with description type D; else null.
    template <class D>
    const D* as() const;
    /// The nested resource, if it is a T; else null.
    template <class T>
    std::shared_ptr<T> built() const {
        return std::dynamic_pointer_cast<T>(resource);
    }
};

/// Base of all typed descriptions: what a parsed and validated element says. Derived structs add
/// one Attr, Ref or RefList member per attribute.
struct ElementDescription {
    virtual ~ElementDescription() = default;

    std::string tag;               ///< as written; matters where a declaration matches a prefix
    Attr<std::string> name;        ///< of an archive's entry; empty for most nested elements
    Attr<std::string> id;          ///< key of a child of a node
    Place place;                   ///< the element's '<'
    std::uint64_t fingerprint = 0; ///< of the element; see XmlElement
    std::vector<Child> children;   ///< in document order
};

} // namespace terrane
