// SPDX-License-Identifier: BSD-3-Clause
#include "resource/xsd_writer.h"

#include "resource/schema_text.h"
#include "resource/value_types.h"
#include "resource/xml.h"

#include <algorithm>
#include <limits>

namespace terrane {

namespace {

constexpr std::size_t kUnbounded = std::numeric_limits<std::size_t>::max();

std::string occurs(std::size_t atLeast, std::size_t atMost) {
    std::string text;
    if (atLeast != 1) text += " minOccurs=\"" + std::to_string(atLeast) + "\"";
    if (atMost == kUnbounded)
        text += " maxOccurs=\"unbounded\"";
    else if (atMost != 1)
        text += " maxOccurs=\"" + std::to_string(atMost) + "\"";
    return text;
}

class XsdWriter {
public:
    explicit XsdWriter(const Schema& schema)
        : schema_(schema)
        , values_(schema) {}

    std::string write() {
        line(R"(<?xml version="1.0" encoding="UTF-8"?>)");
        line("<!-- Archives of Terrane. Made by terrane schema, not to be edited. -->");
        open(R"(<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">)");
        writeArchive();
        for (const SchemaElement& resource : schema_.resources())
            line(element(resource));
        for (const SchemaType& type : schema_.types())
            writeType(type);
        for (const ValueTypes::Type& type : values_.all())
            writeValueType(type);
        close("</xs:schema>");
        return std::move(text_);
    }

private:
    void line(const std::string& text) {
        text_.append(static_cast<std::size_t>(depth_), ' ');
        text_ += text + "\n";
    }
    void open(const std::string& tag) {
        line(tag);
        ++depth_;
    }
    void close(const std::string& tag) {
        --depth_;
        line(tag);
    }

    void document(const std::string& text) {
        line("<xs:annotation><xs:documentation>" + asXml(text) +
             "</xs:documentation></xs:annotation>");
    }

    static std::string typeName(const SchemaElement& element) {
        return (element.keyed ? "keyed." : "") + element.type->id;
    }
    static std::string element(const SchemaElement& element) {
        return "<xs:element name=\"" + element.tag + "\" type=\"" + typeName(element) + "\"/>";
    }

    void writeArchive() {
        open(R"(<xs:element name="archive">)");
        document("The root of an archive: the resources of a scene, each with a name.");
        open("<xs:complexType>");
        writeChoice(schema_.entries(), 0, kUnbounded);
        // Nobody reads them.
        line(R"(<xs:anyAttribute processContents="skip"/>)");
        close("</xs:complexType>");
        open(R"(<xs:unique name="names">)");
        line(R"(<xs:selector xpath="*"/>)");
        line(R"(<xs:field xpath="@name"/>)");
        close("</xs:unique>");
        close("</xs:element>");
    }

    void writeChoice(const std::vector<SchemaElement>& elements, std::size_t atLeast,
                     std::size_t atMost) {
        if (elements.empty()) return;
        open("<xs:choice" + occurs(atLeast, atMost) + ">");
        for (const SchemaElement& child : elements)
            line(element(child));
        close("</xs:choice>");
    }

    // Elements in any order, those of one rule counted. Each must be decided without looking ahead
    // (XML Schema 1.0, unique particle attribution).
    void writeContent(const SchemaType& type) {
        std::vector<SchemaElement> all, others;
        std::vector<const SchemaRule*> counted;
        for (const SchemaRule& rule : type.rules) {
            all.insert(all.end(), rule.elements.begin(), rule.elements.end());
            if (rule.unbounded())
                others.insert(others.end(), rule.elements.begin(), rule.elements.end());
            else
                counted.push_back(&rule);
        }
        const bool countable =
            counted.size() == 1 && (counted[0]->atMost != kUnbounded || counted[0]->atLeast == 1);
        if (!countable) return writeChoice(all, 0, kUnbounded);
        const SchemaRule& rule = *counted[0];
        if (others.empty()) return writeChoice(rule.elements, rule.atLeast, rule.atMost);
        open("<xs:sequence>");
        writeChoice(others, 0, kUnbounded);
        if (rule.atMost == kUnbounded) {
            writeChoice(rule.elements, 1, 1);
            writeChoice(all, 0, kUnbounded);
        } else {
            open("<xs:sequence" + occurs(rule.atLeast, rule.atMost) + ">");
            writeChoice(rule.elements, 1, 1);
            writeChoice(others, 0, kUnbounded);
            close("</xs:sequence>");
        }
        close("</xs:sequence>");
    }

    void writeType(const SchemaType& type) {
        if (type.declaration->acceptsAnything) {
            writeAnything(type, false);
            if (schema_.isKeyed(type)) writeAnything(type, true);
            return;
        }
        open("<xs:complexType name=\"" + type.id + "\">");
        document(documentation(*type.declaration));
        writeContent(type);
        writeAttributes(*type.declaration);
        close("</xs:complexType>");
        if (schema_.isKeyed(type)) writeKeyed(type);
    }

    void writeKeyed(const SchemaType& type) {
        open("<xs:complexType name=\"keyed." + type.id + "\">");
        document(documentation(*type.declaration));
        open("<xs:complexContent>");
        open("<xs:extension base=\"" + type.id + "\">");
        writeText("id", kIdSummary, true);
        close("</xs:extension>");
        close("</xs:complexContent>");
        close("</xs:complexType>");
    }

    void writeAnything(const SchemaType& type, bool keyed) {
        open("<xs:complexType name=\"" + std::string(keyed ? "keyed." : "") + type.id +
             "\" mixed=\"true\">");
        document(documentation(*type.declaration));
        open("<xs:sequence>");
        line(R"(<xs:any processContents="skip" minOccurs="0" maxOccurs="unbounded"/>)");
        close("</xs:sequence>");
        if (keyed) writeText("id", kIdSummary, true);
        writeText("name", kNameSummary, false);
        line(R"(<xs:anyAttribute processContents="skip"/>)");
        close("</xs:complexType>");
    }

    void writeText(const std::string& name, const std::string& summary, bool required) {
        open("<xs:attribute name=\"" + name + "\" type=\"xs:string\"" +
             (required ? " use=\"required\"" : "") + ">");
        document(asSentence(summary));
        close("</xs:attribute>");
    }

    void writeAttributes(const ElementDeclaration& d) {
        if (d.named && !d.attribute("name")) writeText("name", kNameSummary, false);
        for (const AttributeDeclaration& a : d.attributes) {
            writeAttribute(d, a, a.name);
            for (const std::string& alias : a.aliases)
                writeAttribute(d, a, alias);
        }
    }

    void writeAttribute(const ElementDeclaration& d, const AttributeDeclaration& a,
                        const std::string& name) {
        const std::string& type = values_.nameOf(a);
        std::string tag = "<xs:attribute name=\"" + name + "\" type=\"" +
                          (type.empty() ? "xs:string" : type) + "\"";
        const auto byDefault = writtenDefault(d, a);
        if (a.required && a.aliases.empty()) tag += " use=\"required\"";
        if (byDefault && a.aliases.empty()) tag += " default=\"" + asXml(*byDefault) + "\"";
        open(tag + ">");
        document(documentation(schema_, d, a));
        close("</xs:attribute>");
    }

    void writeValueType(const ValueTypes::Type& type) {
        open("<xs:simpleType name=\"" + type.name + "\">");
        if (type.forms.size() == 1) {
            writeForm(type.forms[0]);
        } else {
            open("<xs:union>");
            for (const ValueForm& form : type.forms) {
                open("<xs:simpleType>");
                writeForm(form);
                close("</xs:simpleType>");
            }
            close("</xs:union>");
        }
        close("</xs:simpleType>");
    }

    void writeFacet(const std::string& facet, const std::string& value) {
        line("<xs:" + facet + " value=\"" + asXml(value) + "\"/>");
    }

    void writeForm(const ValueForm& form) {
        using Base = ValueForm::Base;
        const char* const base = form.base == Base::integer ? "integer"
                                 : form.base == Base::real  ? "double"
                                                            : "string";
        open("<xs:restriction base=\"xs:" + std::string(base) + "\">");
        for (const std::string& word : form.words)
            writeFacet("enumeration", word);
        if (!form.pattern.empty()) writeFacet("pattern", form.pattern);
        if (form.notEmpty) writeFacet("minLength", "1");
        if (form.minimum)
            writeFacet(form.minimum->excluded ? "minExclusive" : "minInclusive",
                       form.minimum->value);
        if (form.maximum) writeFacet("maxInclusive", form.maximum->value);
        close("</xs:restriction>");
    }

    const Schema& schema_;
    ValueTypes values_;
    std::string text_;
    int depth_ = 0;
};

} // namespace

std::string writeXsd(const Schema& schema) {
    return XsdWriter(schema).write();
}

} // namespace terrane
