// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/schema.h"

#include <string>

/// What the documentation in schemas and the manual say in the same words.
namespace terrane {

/// With a capital and a full stop.
std::string asSentence(std::string text);

/// What an attribute may refer to, as people name it: "tile cache", "texture", "any resource".
std::string referredName(const Registry& registry, const AttributeDeclaration& attribute);
/// Tags of the types that an attribute may refer to, of those that are built; none when any will
/// do.
std::vector<std::string> referredTags(const Registry& registry,
                                      const AttributeDeclaration& attribute);

/// Sentences on an element or attribute, as plain text.
std::string documentation(const ElementDeclaration& element);
std::string documentation(const Schema& schema, const ElementDeclaration& element,
                          const AttributeDeclaration& attribute);

inline constexpr const char* kNameSummary = "name by which others refer to the resource";
inline constexpr const char* kIdSummary = "key by which methods find it at the node";

} // namespace terrane
