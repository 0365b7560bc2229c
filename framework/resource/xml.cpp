// SPDX-License-Identifier: BSD-3-Clause
#include "resource/xml.h"

#include "core/text.h"
#include "resource/xml_fault.h"

#include <cctype>
#include <cstring>
#include <functional>
#include <string_view>

namespace terrane {

namespace {

// The parser's own words, for what the scanner does not know.
XmlFault faultOf(const pugi::xml_parse_result& result) {
    std::string message = result.description();
    message[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(message[0])));
    return {static_cast<std::size_t>(result.offset), message, {}};
}

// Texts that the parser would take for something else.
std::optional<XmlFault> wrongEncoding(const std::string& text) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        return XmlFault{0, "the file is in UTF-16", "UTF-8"};
    const std::size_t zero = text.find('\0');
    if (zero == std::string::npos) return std::nullopt;
    return XmlFault{zero, "the file holds a zero byte", "text"};
}

std::uint64_t hashOf(const char* text) {
    return std::hash<std::string_view>()(text);
}

// As the order counts, the sum so far is stirred before the next part comes.
std::uint64_t combined(std::uint64_t sum, std::uint64_t part) {
    return (sum ^ (sum >> 29)) * 0xbf58476d1ce4e5b9u + part; // the multiplier of SplitMix64
}

// Deeper than the parser accepts, nothing counts.
constexpr int kDeepest = 300;

std::uint64_t fingerprintOf(const pugi::xml_node& node, int depth = 0) {
    std::uint64_t attributes = 0; // in any order
    for (const pugi::xml_attribute attribute : node.attributes())
        attributes += combined(hashOf(attribute.name()), hashOf(attribute.value()));
    std::uint64_t sum = combined(hashOf(node.name()), attributes);
    for (const pugi::xml_node child : node.children()) {
        if (child.type() == pugi::node_element && depth < kDeepest)
            sum = combined(sum, fingerprintOf(child, depth + 1));
    }
    return combined(sum, 1); // the end of the children
}

} // namespace

std::shared_ptr<const XmlDocument> XmlDocument::parse(std::shared_ptr<const SourceFile> source,
                                                      Diagnostics& diagnostics) {
    auto document = std::make_shared<XmlDocument>();
    document->source_ = std::move(source);
    const std::string& text = document->source_->text();
    std::optional<XmlFault> fault = wrongEncoding(text);
    if (!fault) {
        // The encoding is not converted, so that offsets into the text stay true.
        const pugi::xml_parse_result result = document->document_.load_buffer(
            text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
        const bool empty = result.status == pugi::status_no_document_element;
        if (!result && !empty) fault = findXmlFault(text);
        if (!result && !empty && !fault) fault = faultOf(result);
        if (!fault && !document->document_.document_element())
            fault = XmlFault{0, "there is no element", "a root element such as <archive>"};
    }
    if (fault) {
        diagnostics.error("xml-syntax", {document->source_, fault->offset},
                          "XML syntax: " + fault->message, fault->expected);
        return nullptr;
    }
    for (const std::size_t offset : findLooseCharacters(text)) {
        const bool tag = text[offset] == '<';
        diagnostics.warning("xml-character", {document->source_, offset},
                            tag ? "a '<' in a value, where XML has none"
                                : "a '&' that starts no entity of XML",
                            tag ? "&lt;" : "&amp;");
    }
    const pugi::xml_node root = document->document_.document_element();
    for (pugi::xml_node next = root.next_sibling(); next; next = next.next_sibling()) {
        if (next.type() != pugi::node_element) continue;
        diagnostics.warning("extra-root", XmlElement(document, next).place(),
                            "what follows the root element <" + std::string(root.name()) +
                                "> is ignored",
                            "one root element");
        break;
    }
    return document;
}

XmlElement XmlDocument::root() const {
    return {shared_from_this(), document_.document_element()};
}

XmlElement XmlElement::blamedOn(Place place) const {
    XmlElement copy = *this;
    copy.blame_ = std::move(place);
    return copy;
}

Place XmlElement::place() const {
    if (blame_) return blame_;
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
        const Place namePlace = blame_ ? blame_ : Place{source, name};
        const Place valuePlace = blame_ ? blame_ : Place{source, quote + 1};
        result.push_back({attribute.name(), attribute.value(), namePlace, valuePlace});
        i = text.find(text[quote], quote + 1) + 1;
    }
    return result;
}

std::vector<XmlElement> XmlElement::children() const {
    std::vector<XmlElement> result;
    for (const pugi::xml_node child : node_.children()) {
        if (child.type() != pugi::node_element) continue;
        result.emplace_back(document_, child);
        result.back().blame_ = blame_;
    }
    return result;
}

std::uint64_t XmlElement::fingerprint() const {
    return fingerprintOf(node_);
}

Place XmlElement::textPlace() const {
    for (const pugi::xml_node child : node_.children()) {
        const bool text = child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata;
        if (!text || isBlank(child.value())) continue;
        const std::size_t blanks = std::strspn(child.value(), " \t\r\n");
        if (blame_) return blame_;
        return {document_->source(), static_cast<std::size_t>(child.offset_debug()) + blanks};
    }
    return {};
}

std::string asXml(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += c;
    }
    return result;
}

} // namespace terrane
