// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace terrane {

/// An attribute of a resource that stands in an XML file: of the root's child of that name, or,
/// where the root is no archive, of the root itself.
struct AttributePlace {
    std::string resource;
    std::string attribute;
};

/// What the attribute says in the text of a file; nothing when it is not written there. Entities
/// are decoded.
std::optional<std::string> attributeValue(const std::string& text, const AttributePlace& place);

/// The text with another value of the attribute, and nothing else changed. Nothing when the text is
/// no XML, or has no such resource.
std::optional<std::string> withAttribute(const std::string& text, const AttributePlace& place,
                                         const std::string& value);

} // namespace terrane
