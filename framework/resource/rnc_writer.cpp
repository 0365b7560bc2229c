// SPDX-License-Identifier: BSD-3-Clause
#include "resource/rnc_writer.h"

#include "resource/schema_text.h"
#include "resource/value_types.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace terrane {

namespace {

constexpr std::size_t kUnbounded = std::numeric_limits<std::size_t>::max();

constexpr const char* kStart = R"(# Archives of Terrane. Made by terrane schema, not to be edited.
default namespace = ""
namespace xsi = "http://www.w3.org/2001/XMLSchema-instance"
datatypes xsd = "http://www.w3.org/2001/XMLSchema-datatypes"

anything = (attribute * { text } | text | element * { anything })*
beside.id = attribute * - id { text }*, (text | element * { anything })*
hint = attribute xsi:* { text }*
)";

// An identifier; words of the language need a backslash.
std::string escaped(const std::string& name) {
    static constexpr const char* kKeywords[] = {
        "attribute", "datatypes", "default", "div",  "element", "empty",     "external",
        "grammar",   "include",   "inherit", "list", "mixed",   "namespace", "notAllowed",
        "parent",    "start",     "string",  "text", "token"};
    const bool keyword =
        std::find(std::begin(kKeywords), std::end(kKeywords), name) != std::end(kKeywords);
    return keyword ? "\\" + name : name;
}

// A literal in quotes, of which neither kind may stand in it together with the other.
std::string literal(const std::string& text) {
    return text.find('"') == std::string::npos ? "\"" + text + "\"" : "'" + text + "'";
}

std::string joined(const std::vector<std::string>& pieces, const std::string& separator) {
    std::string text;
    for (const std::string& piece : pieces)
        text += (text.empty() ? "" : separator) + piece;
    return text;
}

std::string repeated(const std::string& pattern, std::size_t atLeast, std::size_t atMost) {
    std::vector<std::string> pieces(atLeast, pattern);
    if (atMost == kUnbounded) {
        if (pieces.empty()) return pattern + "*";
        pieces.back() += "+";
        return joined(pieces, ", ");
    }
    std::string optional;
    for (std::size_t i = atLeast; i < atMost; ++i)
        optional = optional.empty() ? pattern + "?" : fmt::format("({}, {})?", pattern, optional);
    if (!optional.empty()) pieces.push_back(optional);
    return joined(pieces, ", ");
}

std::string form(const ValueForm& form) {
    using Base = ValueForm::Base;
    if (!form.words.empty()) {
        std::vector<std::string> words;
        for (const std::string& word : form.words)
            words.push_back("string " + literal(word));
        return joined(words, " | ");
    }
    std::string text = form.base == Base::integer ? "xsd:integer"
                       : form.base == Base::real  ? "xsd:double"
                                                  : "xsd:string";
    std::string parameters;
    const auto add = [&](const char* facet, const std::string& value) {
        parameters += std::string(" ") + facet + " = " + literal(value);
    };
    if (!form.pattern.empty()) add("pattern", form.pattern);
    if (form.notEmpty) add("minLength", "1");
    if (form.minimum)
        add(form.minimum->excluded ? "minExclusive" : "minInclusive", form.minimum->value);
    if (form.maximum) add("maxInclusive", form.maximum->value);
    return parameters.empty() ? text : text + " {" + parameters + " }";
}

class RncWriter {
public:
    explicit RncWriter(const Schema& schema)
        : schema_(schema)
        , values_(schema) {}

    std::string write() {
        text_ = kStart;
        writeRoots();
        for (const SchemaType& type : schema_.types())
            writeType(type);
        for (const ValueTypes::Type& type : values_.all()) {
            std::vector<std::string> forms;
            for (const ValueForm& each : type.forms)
                forms.push_back(form(each));
            text_ += "\nvalue." + type.name + " = " + joined(forms, " | ");
        }
        return std::move(text_) + "\n";
    }

private:
    static void document(std::string& text, const std::string& indent,
                         const std::string& documentation) {
        text += indent + "## " + documentation + "\n";
    }

    void writeRoots() {
        std::vector<std::string> roots{"archive"};
        for (const SchemaElement& resource : schema_.resources())
            roots.push_back("element " + escaped(resource.tag) + " { " +
                            (resource.type->declaration->acceptsAnything ? "" : "hint, ") +
                            content(*resource.type) + " }");
        text_ += "\nstart =\n  " + joined(roots, "\n  | ") + "\n\n";
        document(text_, "", "The root of an archive: the resources of a scene, each with a name.");
        text_ += "archive = element archive {\n  attribute * { text }*,\n  " +
                 repeated(choice(schema_.entries()), 0, kUnbounded) + "\n}\n";
    }

    static std::string content(const SchemaType& type) {
        if (type.declaration->acceptsAnything) return "attribute id { text }?, beside.id";
        return "content." + type.id;
    }

    // One reference for all elements of a type: a prefix stands for many tags.
    static std::string choice(const std::vector<SchemaElement>& elements) {
        std::vector<std::string> names;
        for (const SchemaElement& element : elements) {
            std::string name = (element.keyed ? "keyed." : "element.") + element.type->id;
            if (names.empty() || names.back() != name) names.push_back(std::move(name));
        }
        std::sort(names.begin(), names.end());
        names.erase(std::unique(names.begin(), names.end()), names.end());
        return "(" + joined(names, "\n    | ") + ")";
    }

    static std::string children(const SchemaType& type) {
        std::vector<SchemaElement> others;
        std::vector<std::string> parts;
        for (const SchemaRule& rule : type.rules) {
            if (rule.unbounded())
                others.insert(others.end(), rule.elements.begin(), rule.elements.end());
            else
                parts.push_back("(" + repeated(choice(rule.elements), rule.atLeast, rule.atMost) +
                                ")");
        }
        if (!others.empty()) parts.push_back(repeated(choice(others), 0, kUnbounded));
        return joined(parts, "\n  & ");
    }

    void writeType(const SchemaType& type) {
        const ElementDeclaration& d = *type.declaration;
        std::vector<std::string> tags;
        for (const std::string& tag : d.tags())
            tags.push_back(escaped(tag));
        const std::string name = tags.size() == 1 ? tags[0] : "(" + joined(tags, " | ") + ")";
        text_ += "\n";
        document(text_, "", documentation(d));
        text_ += "element." + type.id + " = element " + name + " { " + content(type) + " }\n";
        if (schema_.isKeyed(type))
            text_ += "keyed." + type.id + " = element " + name + " { attribute id { text }, " +
                     (d.acceptsAnything ? "beside.id" : "content." + type.id) + " }\n";
        if (!d.acceptsAnything) writeContent(type);
    }

    void writeContent(const SchemaType& type) {
        const ElementDeclaration& d = *type.declaration;
        std::vector<std::string> parts;
        if (d.named && !d.attribute("name")) {
            std::string part = "\n";
            document(part, "  ", asSentence(kNameSummary));
            parts.push_back(part + "  attribute name { text }?");
        }
        for (const AttributeDeclaration& a : d.attributes)
            parts.push_back(attribute(d, a));
        if (const std::string nested = children(type); !nested.empty())
            parts.push_back("\n  (" + nested + ")");
        if (parts.empty()) parts.push_back(" empty");
        text_ += "content." + type.id + " =" + joined(parts, ",") + "\n";
    }

    std::string attribute(const ElementDeclaration& d, const AttributeDeclaration& a) const {
        const std::string& type = values_.nameOf(a);
        const std::string value = type.empty() ? "text" : "value." + type;
        std::vector<std::string> names{escaped(a.name)};
        for (const std::string& alias : a.aliases)
            names.push_back(escaped(alias));
        for (std::string& name : names)
            name = fmt::format("attribute {} {{ {} }}", name, value);
        std::string text = names.size() == 1 ? "\n" : "\n  (\n";
        document(text, "  ", documentation(schema_, d, a));
        text += "  " + joined(names, " | ") + (names.size() == 1 ? "" : ")");
        return text + (a.required ? "" : "?");
    }

    const Schema& schema_;
    ValueTypes values_;
    std::string text_;
};

} // namespace

std::string writeRnc(const Schema& schema) {
    return RncWriter(schema).write();
}

} // namespace terrane
