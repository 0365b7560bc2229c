// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/schema.h"

#include <map>
#include <string>
#include <vector>

namespace terrane {

/// What the manual says of one element type.
class ManualSections {
public:
    explicit ManualSections(const Schema& schema);

    /// The section of a type, with those of its local elements behind it.
    std::string write(const SchemaType& type) const;
    /// A link to a type's section, from the pages of a chapter; from the index with no chapter.
    std::string link(const SchemaType& type, const std::string& chapter) const;
    static std::string chapterOf(const SchemaType& type);

private:
    using Types = std::vector<const SchemaType*>;

    std::string heading(const SchemaType& type) const;
    std::string parents(const SchemaType& type) const;
    std::string attributes(const SchemaType& type) const;
    std::string row(const SchemaType& type, const AttributeDeclaration& a) const;
    std::string value(const SchemaType& type, const AttributeDeclaration& a) const;
    std::string referred(const SchemaType& type, const AttributeDeclaration& a) const;
    std::string words(const SchemaType& type) const;
    std::string children(const SchemaType& type) const;
    std::string builtTypes(std::type_index interface, const std::string& chapter) const;
    std::string usedBy(const SchemaType& type) const;
    std::string list(const Types& types, const std::string& chapter,
                     const std::string& lastWord = " or ") const;
    Types locals(const SchemaType& type) const;

    const Schema& schema_;
    std::map<const SchemaType*, const SchemaType*> parent_; ///< of local elements: the first
    std::map<std::string, const SchemaType*> byTag_;        ///< resources
    /// Long lists of words, and the first type that has each.
    std::map<std::vector<std::string>, const SchemaType*> longLists_;
};

} // namespace terrane
