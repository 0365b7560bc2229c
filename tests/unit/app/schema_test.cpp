// SPDX-License-Identifier: BSD-3-Clause
// The schema of archives against every XML file of the repository, with xmllint as the judge: what
// is well formed by our parser validates, and of what the fixtures expect to be told, all that is
// in the reach of a schema is found, at its line.
#include "resource/parser.h"
#include "resource/rnc_writer.h"
#include "resource/schema.h"
#include "resource/xml.h"
#include "resource/xsd_writer.h"

#include "archive_folder.h"
#include "xmllint.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>

using namespace terrane;
using namespace terrane::test;
namespace fs = std::filesystem;

namespace {

/// A line "expect diagnostic CODE FILE:LINE:COL" of a fixture, or what the parser says.
struct Expected {
    std::string code;
    int line = 0, column = 0;
    bool operator==(const Expected&) const = default;
};

/// An XML file, and what its fixture expects of its form.
struct Subject {
    fs::path file;
    std::vector<Expected> expected;
};

const std::set<std::string> kCodesOfForm{
    "unknown-attribute", "missing-attribute", "unknown-element",     "missing-element",
    "too-many-elements", "wrong-kind",        "out-of-range",        "unknown-word",
    "boolean-word",      "trailing-garbage",  "text-ignored",        "duplicate-name",
    "xml-syntax",        "extra-root",        "duplicate-attribute", "xml-character"};

// Some archives that work draw a warning, which their fixtures don't mention.
void addTold(const fs::path& file, std::vector<Expected>& result) {
    Diagnostics diagnostics;
    const auto text = std::make_shared<SourceFile>(file.string(), *readFile(file));
    const auto document = XmlDocument::parse(text, diagnostics);
    if (!document || document->root().tag() != "archive") return;
    for (const XmlElement& entry : document->root().children()) {
        const ElementDeclaration* const declaration = standardRegistry().find(entry.tag());
        if (declaration) parseElement(entry, *declaration, standardRegistry(), diagnostics);
    }
    for (const Diagnostic& d : diagnostics.all()) {
        const LineColumn at = d.place.position();
        if (kCodesOfForm.contains(d.code)) result.push_back({d.code, at.line, at.column});
    }
}

std::vector<Expected> expectedOf(const fs::path& file) {
    std::vector<Expected> result;
    fs::path folder = file.parent_path();
    while (!fs::exists(folder / "script") && folder.has_relative_path())
        folder = folder.parent_path();
    addTold(file, result);
    std::istringstream script(readFile(folder / "script").value_or(""));
    for (std::string line; std::getline(script, line);) {
        std::istringstream words(line);
        std::string expect, diagnostic, code, place;
        words >> expect >> diagnostic >> code >> place;
        if (expect != "expect" || diagnostic != "diagnostic") continue;
        if (!kCodesOfForm.contains(code)) continue;
        const std::size_t colon = place.find(':');
        const fs::path named = folder / place.substr(0, colon);
        if (colon == std::string::npos || named.filename() != file.filename()) continue;
        Expected expected{code};
        std::sscanf(place.c_str() + colon, ":%d:%d", &expected.line, &expected.column);
        if (std::find(result.begin(), result.end(), expected) == result.end())
            result.push_back(expected);
    }
    return result;
}

std::vector<Subject> subjects(const fs::path& source) {
    std::vector<Subject> result;
    for (const char* folder : {"archives", "resources", "tests/fixtures"}) {
        for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
            const fs::path& file = entry.path();
            if (file.extension() != ".xml" || file.filename() == "schemas.xml") continue;
            result.push_back({file, expectedOf(file)});
        }
    }
    return result;
}

/// What stands at a place of an archive: an element, or an attribute of it, by its declarations.
struct Spot {
    std::optional<XmlElement> element;
    const SchemaType* type = nullptr; ///< of the element; null where none may stand
    const SchemaType* parent = nullptr;
    bool keyed = false;
    std::optional<XmlAttribute> attribute;
};

class Finder {
public:
    Finder(const Schema& schema, std::size_t offset)
        : schema_(schema)
        , offset_(offset) {}

    Spot find(const XmlElement& root) {
        if (root.tag() == "archive")
            visitAll(root, schema_.entries(), nullptr);
        else
            visitOne(root, schema_.resources(), nullptr);
        return spot_;
    }

private:
    void visitAll(const XmlElement& parent, const std::vector<SchemaElement>& allowed,
                  const SchemaType* parentType) {
        for (const XmlElement& child : parent.children())
            visitOne(child, allowed, parentType);
    }

    // The last element that starts before the place holds it, or an attribute at it.
    void visitOne(const XmlElement& element, const std::vector<SchemaElement>& allowed,
                  const SchemaType* parentType) {
        if (element.place().offset > offset_) return;
        Spot spot{element, nullptr, parentType};
        for (const SchemaElement& each : allowed) {
            if (each.tag != element.tag()) continue;
            spot.type = each.type;
            spot.keyed = each.keyed;
        }
        for (const XmlAttribute& attribute : element.attributes()) {
            const std::size_t end = attribute.valuePlace.offset + attribute.value.size();
            if (attribute.namePlace.offset <= offset_ && offset_ <= end) spot.attribute = attribute;
        }
        spot_ = spot;
        std::vector<SchemaElement> children;
        if (spot.type) {
            for (const SchemaRule& rule : spot.type->rules)
                children.insert(children.end(), rule.elements.begin(), rule.elements.end());
        }
        visitAll(element, children, spot.type);
    }

    const Schema& schema_;
    std::size_t offset_;
    Spot spot_;
};

// Whether the attribute's own reader says so, rather than a rule across attributes, which no schema
// knows.
bool isOfValue(const Spot& spot, const std::string& code) {
    if (!spot.type || !spot.attribute) return false;
    const AttributeDeclaration* const a = spot.type->declaration->attribute(spot.attribute->name);
    if (!a || !a->read) return false;
    const bool list = a->kind == ValueKind::integerList || a->kind == ValueKind::realList;
    if (list && code == "out-of-range") return false;
    Diagnostics diagnostics;
    const auto description = spot.type->declaration->makeDescription();
    a->read({spot.attribute->value, {}, {}}, *description, diagnostics);
    const std::vector<Diagnostic> told = diagnostics.all();
    return std::any_of(told.begin(), told.end(),
                       [&](const Diagnostic& d) { return d.code == code; });
}

bool lacksAttribute(const Spot& spot) {
    if (!spot.type) return false;
    const auto has = [&](const std::string& name) {
        const auto all = spot.element->attributes();
        return std::any_of(all.begin(), all.end(),
                           [&](const XmlAttribute& a) { return a.name == name; });
    };
    if (spot.keyed && !has("id")) return true;
    for (const AttributeDeclaration& a : spot.type->declaration->attributes) {
        if (a.required && a.aliases.empty() && !has(a.name)) return true;
    }
    return false;
}

constexpr std::size_t kUnbounded = std::numeric_limits<std::size_t>::max();

bool hasRule(const Spot& spot, std::size_t SchemaRule::*count, std::size_t usual) {
    if (!spot.type) return false;
    const auto& rules = spot.type->rules;
    return std::any_of(rules.begin(), rules.end(),
                       [&](const SchemaRule& rule) { return rule.*count != usual; });
}

// Whether a schema can tell; without regard to what ours does.
bool isInReach(const Spot& spot, const std::string& code) {
    if (code == "xml-syntax" || code == "extra-root" || code == "duplicate-attribute" ||
        code == "text-ignored" || code == "duplicate-name" || code == "xml-character")
        return true;
    if (!spot.element) return false;
    if (code == "missing-element") return hasRule(spot, &SchemaRule::atLeast, 0);
    if (code == "too-many-elements") return hasRule(spot, &SchemaRule::atMost, kUnbounded);
    if (code == "unknown-element") return !spot.type;
    if (code == "missing-attribute") return lacksAttribute(spot);
    if (code == "unknown-attribute")
        return spot.type && spot.attribute &&
               !spot.type->declaration->attribute(spot.attribute->name);
    return isOfValue(spot, code);
}

// A part of a text is replaced by blanks, its lines are kept.
void blank(std::string& text, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
        if (text[i] != '\n') text[i] = ' ';
    }
}

// Comments and declarations of XML left out, where our parser takes more than the letter allows, as
// archives of the original need.
std::string strict(std::string text) {
    bool tolerated = text.find("<?xml", 1) != std::string::npos;
    std::string bare = text;
    for (std::size_t at; (at = bare.find("<!--")) != std::string::npos;) {
        const std::size_t end = bare.find("-->", at + 4);
        if (end == std::string::npos) return text;
        tolerated |= bare.substr(at + 4, end - at - 4).find("--") != std::string::npos;
        blank(bare, at, end + 3);
    }
    for (std::size_t at; (at = bare.find("<?xml")) != std::string::npos;)
        blank(bare, at, bare.find("?>", at) + 2);
    bare.erase(0, bare.find('<'));
    return tolerated ? bare : text;
}

std::size_t endOfElement(const std::string& text, std::size_t begin) {
    int depth = 0;
    for (std::size_t i = begin; i < text.size();) {
        if (text.compare(i, 4, "<!--") == 0) {
            i = text.find("-->", i) + 3;
            continue;
        }
        if (text[i] != '<') {
            ++i;
            continue;
        }
        const bool closing = text[i + 1] == '/';
        while (text[i] != '>') {
            if (text[i] == '"' || text[i] == '\'') i = text.find(text[i], i + 1);
            ++i;
        }
        const bool empty = text[i - 1] == '/';
        depth += closing ? -1 : empty ? 0 : 1;
        ++i;
        if (depth == 0) return i;
    }
    return text.size();
}

// Whether a schema that does not know some codes can tell that a file is broken.
bool isBroken(const Schema& schema, const Subject& subject, const std::set<std::string>& unknown) {
    Diagnostics diagnostics;
    const auto text = std::make_shared<SourceFile>("", *readFile(subject.file));
    const auto document = XmlDocument::parse(text, diagnostics);
    return std::any_of(subject.expected.begin(), subject.expected.end(), [&](const Expected& e) {
        Spot spot;
        if (document)
            spot = Finder(schema, text->offset({e.line, e.column})).find(document->root());
        return !unknown.contains(e.code) && isInReach(spot, e.code);
    });
}

fs::path sourceFolder() {
    const char* const source = std::getenv("TERRANE_SOURCE");
    return source ? source : "";
}

bool canJudge() {
    if (!sourceFolder().empty() && Xmllint::installed()) return true;
    MESSAGE("skipped: no sources, or no xmllint");
    return false;
}

} // namespace

TEST_CASE("every archive validates, but for those that a schema can know to be broken") {
    if (!canJudge()) return;
    const Schema schema(standardRegistry());
    const TemporaryFolder folder;
    const fs::path xsd = folder.file("terrane.xsd", writeXsd(schema));
    const std::vector<Subject> all = subjects(sourceFolder());
    std::vector<std::string> files;
    for (const Subject& subject : all) {
        const std::string text = *readFile(subject.file);
        const std::string copy = strict(text);
        const std::string name = std::to_string(files.size()) + ".xml";
        files.push_back(copy == text ? subject.file.string() : folder.file(name, copy).string());
    }
    auto verdicts = Xmllint::validate("--schema", xsd, files);
    const std::set<std::string> nothing;
    int good = 0, broken = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Subject& subject = all[i];
        const std::string file = subject.file.string();
        CAPTURE(file);
        const auto& verdict = verdicts[files[i]];
        CAPTURE(verdict.report);
        const bool inReach = isBroken(schema, subject, nothing);
        CHECK(verdict.valid == !inReach);
        ++(inReach ? broken : good);
    }
    MESSAGE(good << " good, " << broken << " broken");
}

TEST_CASE("each fault that a schema can know is found at its element") {
    if (!canJudge()) return;
    const Schema schema(standardRegistry());
    const TemporaryFolder folder;
    const fs::path xsd = folder.file("terrane.xsd", writeXsd(schema));
    struct Case {
        std::string file, fixture, code;
        int first = 0, last = 0; ///< lines of the start tag
    };
    std::vector<Case> cases;
    std::vector<std::string> files;
    for (const Subject& subject : subjects(sourceFolder())) {
        Diagnostics diagnostics;
        const auto text = std::make_shared<SourceFile>("", *readFile(subject.file));
        const auto document = XmlDocument::parse(text, diagnostics);
        const bool isXml =
            strict(text->text()) == text->text() &&
            std::none_of(subject.expected.begin(), subject.expected.end(),
                         [](const Expected& e) { return e.code == "duplicate-attribute"; });
        if (!document || !diagnostics.all().empty() || !isXml) continue;
        // After an element that may not stand somewhere, validators skip its siblings. So all of
        // these are left out, or all but one.
        std::vector<std::pair<std::size_t, std::size_t>> unknown;
        for (const Expected& expected : subject.expected) {
            const std::size_t offset = text->offset({expected.line, expected.column});
            if (expected.code == "unknown-element")
                unknown.emplace_back(offset, endOfElement(text->text(), offset));
        }
        for (const Expected& expected : subject.expected) {
            const std::size_t offset = text->offset({expected.line, expected.column});
            const Spot spot = Finder(schema, offset).find(document->root());
            if (!isInReach(spot, expected.code) || !spot.element) continue;
            if (expected.code == "text-ignored") continue; // is told at the element around
            std::string variant = text->text();
            for (const auto& [begin, end] : unknown) {
                if (offset < begin || offset >= end) blank(variant, begin, end);
            }
            const std::string name = std::to_string(cases.size()) + ".xml";
            const std::size_t begin = spot.element->place().offset;
            std::size_t end = begin;
            for (; variant[end] != '>'; ++end) {
                if (variant[end] == '"') end = variant.find('"', end + 1);
            }
            files.push_back(folder.file(name, variant).string());
            cases.push_back({files.back(), subject.file.string(), expected.code,
                             text->position(begin).line, text->position(end).line});
        }
    }
    auto verdicts = Xmllint::validate("--schema", xsd, files);
    for (const Case& each : cases) {
        CAPTURE(each.fixture);
        CAPTURE(each.code);
        CAPTURE(each.first);
        const auto& verdict = verdicts[each.file];
        CAPTURE(verdict.report);
        const auto at = verdict.lines.lower_bound(each.first);
        CHECK((at != verdict.lines.end() && *at <= each.last));
    }
    MESSAGE(cases.size() << " faults");
}

TEST_CASE("nxml-mode of Emacs finds the schema, validates as it says, and completes names") {
    if (sourceFolder().empty() || std::system("emacs --version > /dev/null 2>&1") != 0) {
        MESSAGE("skipped: no sources, or no emacs");
        return;
    }
    const Schema schema(standardRegistry());
    std::string good, broken;
    for (const Subject& subject : subjects(sourceFolder())) {
        const std::string text = *readFile(subject.file);
        if (strict(text) != text) continue;
        // RELAX NG does not compare names.
        const bool isBad = isBroken(schema, subject, {"duplicate-name"});
        (isBad ? broken : good) += " '" + subject.file.string() + "'";
    }
    const TemporaryFolder folder;
    const std::string output = (folder / "output").string();
    const int status = std::system(("cd '" + sourceFolder().string() +
                                    "' && emacs -Q --batch -l tests/editor/nxml-test.el --" + good +
                                    " --broken" + broken + " > '" + output + "' 2>&1")
                                       .c_str());
    std::istringstream lines(readFile(output).value_or(""));
    std::string failures, last;
    for (std::string line; std::getline(lines, line); last = line) {
        if (line.starts_with("FAILED")) failures += line + "\n";
    }
    INFO(failures << last);
    CHECK(status == 0);
    MESSAGE(last);
}
