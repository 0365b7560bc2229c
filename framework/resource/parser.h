// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "resource/declaration.h"
#include "resource/registry.h"
#include "resource/xml.h"

#include <memory>

namespace terrane {

/// A description read from an element. `valid` is false after errors; the description still holds
/// whatever could be read, so that its references can be checked in the same run.
struct ParsedElement {
    const ElementDeclaration* declaration = nullptr;
    std::shared_ptr<ElementDescription> description;
    bool valid = false;
    /// Data files that the element and those in it name, whether they exist or not.
    std::vector<AttributeText> files;
};

/// Reads and validates an element of a declared type with all that is nested in it. Reports every
/// problem, not only the first: unknown-attribute, missing-attribute, duplicate-attribute,
/// wrong-kind, out-of-range, unknown-word, unknown-element, missing-element, too-many-elements.
ParsedElement parseElement(const XmlElement& element, const ElementDeclaration& declaration,
                           const Registry& registry, Diagnostics& diagnostics);

/// The references of a description, those of nested elements included.
/// @param onDemand whether to return those that are loaded on demand, or the others
std::vector<std::pair<const AttributeDeclaration*, RefBase*>>
references(const ElementDeclaration& declaration, ElementDescription& description, bool onDemand);

} // namespace terrane
