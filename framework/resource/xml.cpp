// SPDX-License-Identifier: BSD-3-Clause
#include "resource/xml.h"

#include <cstring>

namespace terrane {

std::shared_ptr<const XmlDocument> XmlDocument::parse(std::shared_ptr<const SourceFile> source,
                                                      Diagnostics& diagnostics) {
    auto document = std::make_shared<XmlDocument>();
    document->source_ = std::move(source);
    const std::string& text = document->source_->text();
    // The encoding is not converted, so that offsets into the text stay true.
    const pugi::xml_parse_result result = document->document_.load_buffer(
        text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
        const Place place{document->source_, static_cast<std::size_t>(result.offset)};
        std::string message = result.description();
        message[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(message[0])));
        diagnostics.error("xml-syntax", place, "XML syntax: " + message);
        return nullptr;
    }
    if (!document->document_.document_element()) {
        diagnostics.error("xml-syntax", {document->source_, 0}, "there is no XML element",
                          "a root element such as <archive>");
        return nullptr;
    }
    return document;
}

XmlElement XmlDocument::root() const {
    return {shared_from_this(), document_.document_element()};
}

Place XmlElement::place() const {
    // pugixml gives the offset of the name.
    return {document_->source(), static_cast<std::size_t>(node_.offset_debug()) - 1};
}

std::vector<XmlAttribute> XmlElement::attributes() const {
    std::vector<XmlAttribute> result;
    const std::string& text = document_->source()->text();
    const auto& source = document_->source();
    // pugixml keeps no places of attributes; they follow the element's name in the text.
    std::size_t i = static_cast<std::size_t>(node_.offset_debug()) + std::strlen(node_.name());
    for (const pugi::xml_attribute attribute : node_.attributes()) {
        const std::size_t name = text.find(attribute.name(), i);
        const std::size_t quote = text.find_first_of("\"'", name);
        if (name == std::string::npos || quote == std::string::npos) break; // can't be: it parsed
        result.push_back(
            {attribute.name(), attribute.value(), Place{source, name}, Place{source, quote + 1}});
        i = text.find(text[quote], quote + 1) + 1;
    }
    return result;
}

std::vector<XmlElement> XmlElement::children() const {
    std::vector<XmlElement> result;
    for (const pugi::xml_node child : node_.children()) {
        if (child.type() == pugi::node_element) result.emplace_back(document_, child);
    }
    return result;
}

} // namespace terrane
