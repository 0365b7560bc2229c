// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/registry.h"

#include <deque>
#include <string>
#include <vector>

namespace terrane {

struct SchemaType;

/// An element that may stand somewhere.
struct SchemaElement {
    std::string tag;
    const SchemaType* type = nullptr;
    bool keyed = false; ///< needs an attribute `id` as well
};

/// Elements of which there may be so many, in any order, among those of other rules.
struct SchemaRule {
    std::vector<SchemaElement> elements;
    std::size_t atLeast = 0;
    std::size_t atMost = 0;

    bool unbounded() const;
};

/// What an element of a declaration may hold. The same tag can have different types in different
/// parents.
struct SchemaType {
    std::string id; ///< "mesh"; "node.mesh" of a local element, after the first parent that has it
    const ElementDeclaration* declaration = nullptr;
    std::vector<SchemaRule> rules; ///< no tag stands in two of them
};

/// The grammar of archives, from the declarations of a registry: what the writers of schemas and
/// of the manual walk. The registry must outlive it.
///
/// It holds what the parser reads without a word: what draws a warning, such as `enabled="yes"`,
/// is no part of it, but for types that are declared and not built yet. Three things it does not
/// know: tags that match a prefix but are none of the known ones, what stands beside an attribute
/// that stands for everything, and rules across attributes.
class Schema {
public:
    explicit Schema(const Registry& registry);
    Schema(const Schema&) = delete;
    Schema& operator=(const Schema&) = delete;

    const Registry& registry() const { return registry_; }
    /// Resource types by their tags, then local ones.
    const std::deque<SchemaType>& types() const { return types_; }
    /// What may stand directly below the root of an archive, in the order of tags.
    const std::vector<SchemaElement>& entries() const { return entries_; }
    /// Resource types: each may be the root of a file of its own.
    const std::vector<SchemaElement>& resources() const { return resources_; }
    /// Whether an element of the type stands somewhere with a key.
    bool isKeyed(const SchemaType& type) const;

private:
    const SchemaType& local(const ElementDeclaration& declaration, const std::string& parent);
    void addRules(SchemaType& type);
    const SchemaType* find(const ElementDeclaration& declaration) const;

    const Registry& registry_;
    std::deque<SchemaType> types_;
    std::vector<SchemaElement> entries_, resources_;
};

} // namespace terrane
