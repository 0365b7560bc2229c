// SPDX-License-Identifier: BSD-3-Clause
#include "resource/attribute_edit.h"

#include "core/text.h"
#include "resource/xml.h"

#include <algorithm>

namespace terrane {

namespace {

std::shared_ptr<const XmlDocument> parse(const std::string& text) {
    Diagnostics ignored;
    return XmlDocument::parse(std::make_shared<SourceFile>("", text), ignored);
}

std::optional<XmlElement> findElement(const XmlDocument& document, const std::string& resource) {
    const XmlElement root = document.root();
    if (root.tag() != "archive") return root;
    for (const XmlElement& child : root.children()) {
        if (child.attribute("name") == resource) return child;
    }
    return std::nullopt;
}

std::optional<XmlAttribute> findAttribute(const XmlElement& element, const std::string& name) {
    const std::vector<XmlAttribute> all = element.attributes();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.name == name; });
    return found == all.end() ? std::nullopt : std::optional(*found);
}

} // namespace

std::optional<std::string> attributeValue(const std::string& text, const AttributePlace& place) {
    const auto document = parse(text);
    const auto element = document ? findElement(*document, place.resource) : std::nullopt;
    const auto found = element ? findAttribute(*element, place.attribute) : std::nullopt;
    return found ? std::optional(found->value) : std::nullopt;
}

std::optional<std::string> withAttribute(const std::string& text, const AttributePlace& place,
                                         const std::string& value) {
    const auto document = parse(text);
    const auto element = document ? findElement(*document, place.resource) : std::nullopt;
    if (!element) return std::nullopt;
    std::string result = text;
    if (const auto known = findAttribute(*element, place.attribute)) {
        const std::size_t begin = known->valuePlace.offset;
        const std::size_t end = text.find(text[begin - 1], begin);
        return result.replace(begin, end - begin, asXml(value));
    }
    const std::size_t afterTag = element->place().offset + 1 + element->tag().size();
    return result.insert(afterTag, " " + place.attribute + "=\"" + asXml(value) + "\"");
}

} // namespace terrane
