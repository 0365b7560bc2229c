// SPDX-License-Identifier: BSD-3-Clause
// Schemas of the test types, which have one of everything: xmllint takes what the parser takes
// without a word, and nothing else.
#include "resource/parser.h"
#include "resource/rnc_writer.h"
#include "resource/schema.h"
#include "resource/test_types.h"
#include "resource/value_grammar.h"
#include "resource/xsd_writer.h"

#include "xmllint.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace terrane;
using namespace terrane::test;

namespace {

const Registry& testRegistry() {
    static const Registry& registry = []() -> const Registry& {
        static Registry r;
        declareTestTypes(r);
        return r;
    }();
    return registry;
}

// Whether the parser reads an entry of an archive, or the root of a file, without a word.
bool isRead(const std::string& xml) {
    Diagnostics diagnostics;
    const auto document =
        XmlDocument::parse(std::make_shared<SourceFile>("test.xml", xml), diagnostics);
    if (!document) return false;
    const XmlElement root = document->root();
    const ElementDeclaration* const declaration = testRegistry().find(root.tag());
    if (!declaration) return false;
    parseElement(root, *declaration, testRegistry(), diagnostics);
    return diagnostics.all().empty();
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text)
        result += c == '"' ? "&quot;" : c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
    return result + "\"";
}

/// Verdicts of xmllint on elements that are the roots of their files.
std::vector<Xmllint::Verdict> validate(const std::vector<std::string>& elements) {
    const TemporaryFolder folder;
    const Schema schema(testRegistry());
    const auto xsd = folder.file("test.xsd", writeXsd(schema));
    std::vector<std::string> files;
    for (const std::string& xml : elements)
        files.push_back(folder.file(std::to_string(files.size()) + ".xml", xml).string());
    auto verdicts = Xmllint::validate("--schema", xsd, files);
    std::vector<Xmllint::Verdict> result;
    for (const std::string& file : files)
        result.push_back(verdicts[file]);
    return result;
}

bool canJudge() {
    if (Xmllint::installed()) return true;
    MESSAGE("skipped: there is no xmllint");
    return false;
}

} // namespace

TEST_CASE("each kind of value is valid when the parser reads it without a word") {
    if (!canJudge()) return;
    const std::vector<std::string> texts{
        "",      "true",       "false",      "True", " true",    "yes",       "0",    "5",
        "+5",    "-5",         "+-5",        "007",  " 7 ",      "7 apples",  "7.5",  "20",
        "21",    "1e1",        ".5",         "5.",   ".",        "-.5e-1",    "1e",   "0.0001",
        "1",     "1.1",        "inf",        "-inf", "INF",      "Infinity",  "nan",  "NaN",
        "1e400", "2147483647", "2147483648", "RED",  "red",      "RED,GREEN", "RED,", ",",
        "1,2",   "1, 2",       "1,,2,",      "1;2",  "1.5,2.5,", "a",         "a,b",  "a.b",
        ".b",    "a.",         "$a.b",       "$.b",  "$",        "this.a.b",  "a b",  "\xc3\xa9",
        "<&\"'", "0x10",       "1 2",        "-0",   " ",        "5,x"};
    // What no pattern can tell: the ranges of lists, and that a number is too large for its kind.
    const auto isBeyond = [](const AttributeDeclaration& a, const std::string& text) {
        const bool list = a.kind == ValueKind::integerList || a.kind == ValueKind::realList;
        return list || text == "1e400";
    };
    std::vector<std::string> elements;
    std::vector<bool> beyond;
    const ElementDeclaration& apple = *testRegistry().find("apple");
    for (const AttributeDeclaration& a : apple.attributes) {
        if (a.required || a.planned) continue;
        for (const std::string& text : texts) {
            elements.push_back("<apple " + a.name + "=" + quoted(text) + "/>");
            beyond.push_back(isBeyond(a, text));
        }
    }
    const auto verdicts = validate(elements);
    int valid = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        CAPTURE(elements[i]);
        CAPTURE(verdicts[i].report);
        const bool read = isRead(elements[i]);
        if (beyond[i])
            CHECK((verdicts[i].valid || !read));
        else
            CHECK(verdicts[i].valid == read);
        valid += verdicts[i].valid ? 1 : 0;
    }
    CHECK(valid > 100);
    CHECK(valid < static_cast<int>(elements.size()) - 100);
}

TEST_CASE("each form of elements is valid when the parser reads it without a word") {
    if (!canJudge()) return;
    const std::vector<std::string> elements{
        "<apple/>",
        "<apple name='a' seeds='3'/>",
        "<apple sweetness='0.5'/>",
        "<apple seed='3'/>",
        "<apple id='a'/>",
        "<apple>text</apple>",
        "<apple><!-- comment --></apple>",
        "<apple><pear kind='k'/></apple>",
        "<pear/>",
        "<pear kind=''/>",
        "<plum/>",
        "<shelf><apple id='a'/><shelf id='b'><pear id='c' kind='k'/></shelf></shelf>",
        "<shelf><apple/></shelf>",
        "<shelf><lid id='a'/></shelf>",
        "<chain><chain/><basket><apple/></basket><shelf/></chain>",
        "<chain><chain id='a'/></chain>",
        "<chain><apple/></chain>",
        "<basket><apple/><uniform name='u'/></basket>",
        "<basket><apple/><value1 name='u'/></basket>",
        "<basket><apple/><uniform1 name='u'/><lid/><uniform2 name='v' x='1'/></basket>",
        "<basket><apple/><uniform1/></basket>",
        "<crate size='3'/>",
        "<mesh source='a.mesh'/>",
    };
    const auto verdicts = validate(elements);
    for (std::size_t i = 0; i < elements.size(); ++i) {
        CAPTURE(elements[i]);
        CAPTURE(verdicts[i].report);
        CHECK(verdicts[i].valid == isRead(elements[i]));
    }
}

TEST_CASE("types that are planned may hold anything") {
    if (!canJudge()) return;
    const auto verdicts =
        validate({"<mould any='1'><thing>text</thing></mould>",
                  "<shelf><mould id='m' any='1'/></shelf>", "<shelf><mould any='1'/></shelf>"});
    CHECK(verdicts[0].valid);
    CHECK(verdicts[1].valid);
    CHECK(!verdicts[2].valid);
}

TEST_CASE("an archive holds resources with different names, and what stands at the top only") {
    if (!canJudge()) return;
    const auto verdicts = validate(
        {"<archive made='today'><apple name='a'/><pear name='b' kind='k'/><player/></archive>",
         "<archive><apple name='a'/><pear name='a' kind='k'/></archive>",
         "<archive><lid/></archive>", "<player/>"});
    CHECK(verdicts[0].valid);
    CHECK(!verdicts[1].valid);
    CHECK(!verdicts[2].valid);
    CHECK(!verdicts[3].valid);
}

TEST_CASE("defaults that can't be written are none") {
    const ElementDeclaration& apple = *testRegistry().find("apple");
    CHECK(writtenDefault(apple, *apple.attribute("seeds")) == "5");
    CHECK(writtenDefault(apple, *apple.attribute("visible")) == "true");
    CHECK(writtenDefault(apple, *apple.attribute("colour")) == "GREEN");
    CHECK(!writtenDefault(apple, *apple.attribute("smell")));
    CHECK(!writtenDefault(apple, *apple.attribute("friend")));
}
