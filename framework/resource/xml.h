// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"

#include <cstdint>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

class XmlElement;

/// An attribute as written, entities decoded, with the places of its name and of its value.
struct XmlAttribute {
    std::string name;
    std::string value;
    Place namePlace;
    Place valuePlace; ///< first character inside the quotes
};

/// A parsed XML file. As tolerant as archives of the original need: comments before the
/// declaration, several declarations, "--" in comments (ork reference 1.5).
class XmlDocument : public std::enable_shared_from_this<XmlDocument> {
public:
    /// Null, with a diagnostic "xml-syntax", when the text is no XML. A second root element is
    /// ignored with a warning "extra-root"; what other parsers would refuse in values is taken as
    /// it is, with a warning "xml-character".
    static std::shared_ptr<const XmlDocument> parse(std::shared_ptr<const SourceFile> source,
                                                    Diagnostics& diagnostics);

    XmlElement root() const;
    const std::shared_ptr<const SourceFile>& source() const { return source_; }

private:
    std::shared_ptr<const SourceFile> source_;
    pugi::xml_document document_;
};

/// An element of a document. Cheap to copy; keeps the document alive.
class XmlElement {
public:
    XmlElement(std::shared_ptr<const XmlDocument> document, pugi::xml_node node)
        : document_(std::move(document))
        , node_(node) {}

    /// The same element, with everything in it placed at one place: for an element that the author
    /// never wrote, because it follows from a name that stands there.
    XmlElement blamedOn(Place place) const;

    std::string tag() const { return node_.name(); }
    Place place() const; ///< the '<'
    std::vector<XmlAttribute> attributes() const;
    std::string attribute(const char* name) const { return node_.attribute(name).value(); }
    std::vector<XmlElement> children() const; ///< elements only
    /// Equal for elements that say the same: of the same tag, attributes in any order, and elements
    /// in them. Comments, blanks and text don't count.
    std::uint64_t fingerprint() const;
    /// Whether both are the same element of the same document.
    bool operator==(const XmlElement& other) const { return node_ == other.node_; }
    /// The first visible character of text that stands in the element; empty when there is none.
    Place textPlace() const;

private:
    std::shared_ptr<const XmlDocument> document_;
    pugi::xml_node node_;
    Place blame_;
};

/// A text as it is written in XML, also between double quotes.
std::string asXml(std::string_view text);

} // namespace terrane
