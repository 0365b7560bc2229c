// SPDX-License-Identifier: BSD-3-Clause
#include "resource/archive_world.h"
#include "resource/xml.h"

#include <doctest/doctest.h>

using namespace terrane;
using namespace terrane::test;

namespace {

std::shared_ptr<const XmlDocument> parse(const std::string& text, Diagnostics& diagnostics) {
    return XmlDocument::parse(std::make_shared<SourceFile>("a.xml", text), diagnostics);
}

std::string lineAndColumn(const Place& place) {
    return std::to_string(place.position().line) + ":" + std::to_string(place.position().column);
}

} // namespace

TEST_CASE("files of the original load, with places as their authors typed them") {
    struct Row {
        std::string name;
        std::string text; // '^' marks the element b, its attribute x and its value
    };
    const Row rows[] = {
        {"plain", "<a>^<b ^x=\"^1\"/></a>"},
        {"a comment before the declaration",
         "<!-- (c) somebody\n all rights -->\n<?xml version=\"1.0\"?>\n<a>\n ^<b ^x=\"^1\"/></a>"},
        {"two declarations on one line",
         "<?xml version=\"1.0\"?><?xml version=\"1.0\"?>\n<a>^<b ^x=\"^1\"/></a>"},
        {"banners of dashes in comments",
         "<!-- ------ X ------ --><a><!------- Y -----><!-- -- -->\n^<b ^x=\"^1\"/></a>"},
        {"an element disabled by a comment", "<a><!--b x=\"0\"/--><!--/b-->^<b ^x=\"^1\"/></a>"},
        {"carriage returns", "<!-- a\r\n b -->\r\n<a>\r\n\t^<b\r\n\t\t^x=\"^1\"\r\n/>\r\n</a>\r\n"},
        {"a byte order mark", "\xef\xbb\xbf<a>\n^<b ^x=\"^1\"/></a>"},
        {"a tag over several lines",
         "<a>\n^<b\n\n  y=\"2\"\n  ^x\n  =\n  \"^1\"\n>\n</b  >\n</a >"},
        {"a blank before the end", "<a >^<b ^x=\"^1\" ></b ></a >"},
        {"single quotes", "<a>^<b y='\"2\"' ^x='^1'/></a>"},
        {"bytes that are not ASCII",
         "<!-- \xc3\xa9\xc3\xa8 --><a y=\"\xc3\xa9\">^<b ^x=\"^1\"/></a>"},
        {"bytes of Latin 1", "<!-- \xe9\xe8 --><a y=\"\xe9\">^<b ^x=\"^1\"/></a>"},
        {"the end of a tag in a value", "<a>^<b y=\"c d='>'\" ^x=\"^1\"/></a>"},
        {"a document type", "<!DOCTYPE a [ <!ELEMENT a (b)> ]><a>^<b ^x=\"^1\"/></a>"},
        {"text and CDATA", "<a>words <![CDATA[<b x=\"0\"/>]]>\n^<b ^x=\"^1\"/></a>"},
        {"an attribute that is like the tag", "<a>^<b b=\"x\" ^x=\"^1\"/></a>"},
        {"values like attributes", "<a>^<b y=\"x='0'\" ^x=\"^1\"/></a>"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        Diagnostics diagnostics;
        MarkedText marked(row.text);
        const auto document = parse(marked.text, diagnostics);
        REQUIRE(document);
        CHECK(diagnostics.all().empty());
        CHECK(document->root().tag() == "a");
        REQUIRE(document->root().children().size() == 1);
        const XmlElement b = document->root().children().front();
        CHECK(b.attribute("x") == "1");
        CHECK(lineAndColumn(b.place()) == marked.places.at(0));
        const XmlAttribute x = b.attributes().back();
        CHECK(x.name == "x");
        CHECK(x.value == "1");
        CHECK(lineAndColumn(x.namePlace) == marked.places.at(1));
        CHECK(lineAndColumn(x.valuePlace) == marked.places.at(2));
    }
}

TEST_CASE("a byte order mark is no part of the first line") {
    Diagnostics diagnostics;
    const auto document = parse("\xef\xbb\xbf<a x='1'/>", diagnostics);
    REQUIRE(document);
    CHECK(lineAndColumn(document->root().place()) == "1:1");
    CHECK(lineAndColumn(document->root().attributes().front().namePlace) == "1:4");
    const std::string text = toString(
        {.code = "c", .place = document->root().attributes().front().namePlace, .message = "m"});
    CHECK(text == "a.xml:1:4: error: m [c]\n    <a x='1'/>\n       ^\n");
}

TEST_CASE("a syntax error is told where the author can mend it") {
    struct Row {
        std::string name;
        const char* text; // '^' marks the place
        const char* message;
    };
    const Row rows[] = {
        {"nothing", "^", "no element"},
        {"blanks", "^ \n ", "no element"},
        {"words", "^hello", "no element"},
        {"only a comment", "^<!-- a -->", "no element"},
        {"only a declaration", "^<?xml version=\"1.0\"?>", "no element"},
        {"an element that is not closed", "^<a>\n<b/>\n", "<a> is not closed"},
        {"a child that is not closed", "<a>\n <b/>\n ^<b>\n</a>\n", "<b> is not closed"},
        {"a child far inside", "<a><b><c>^<d><e/></c></b></a>", "<d> is not closed"},
        {"the file ends in the middle", "<a>\n^<b>\n <c/>", "<b> is not closed"},
        {"another end tag", "<a>\n<node>\n^</nodes>\n</a>", "</nodes> does not close <node>"},
        {"an end tag too many", "<a></a>\n^</b>", "</b> closes no element"},
        {"an end tag that is not closed", "<a><b>^</b\n</a>", "end tag </b is not closed"},
        {"a tag that is not closed", "<a>\n^<b x=\"1\"\n<c/>\n</a>", "tag <b is not closed"},
        {"a tag without a name that is not closed", "<a>^<b", "tag <b is not closed"},
        {"a quote that is not closed, to the end", "<a><b x=^\"1/>\n</a>", "quote is not closed"},
        {"a quote that is not closed, to another one",
         "<a>\n<b x=^\"1>\n<c y=\"2\" z=\"3\"/>\n</b></a>", "quote is not closed"},
        {"a quote that is not closed, to an empty value",
         "<a>\n<b x=^\"1/>\n<c y=\"\" z=\"3\"/>\n</a>", "quote is not closed"},
        {"a quote that is not closed, in its tag", "<a><b x=^\"1 y=\"2\"/></a>",
         "quote is not closed"},
        {"a single quote that is not closed", "<a><b x=^'1' y='2' z=^'3/>\n<c d=\"it\"/></a>",
         "quote is not closed"},
        {"a quote that swallows an element", "<a>\n<b x=^\"1/>\n<c y=\" z=\"3\"/>\n<d/></e></a>",
         "quote is not closed"},
        {"a value without quotes", "<a><b x=^1/></a>", "'x' is not in quotes"},
        {"an opening quote that is missing", "<a><b x=^1\" y=\"2\"/></a>", "'x' is not in quotes"},
        {"an attribute without a value", "<a><b ^x y=\"1\"/></a>", "'x' has no value"},
        {"no blank between attributes", "<a><b x=\"1\"^y=\"2\"/></a>", "no blank"},
        {"a slash in a tag", "<a><b ^/ x=\"1\"></a>", "'/' stands"},
        {"a comma in a tag", "<a><b x=\"1\"^, y=\"2\"/></a>", "',' stands"},
        {"a comment that is not closed", "<a>\n ^<!-- words\n<b/>\n</a>", "comment is not closed"},
        {"a comment that ends too early", "<a><!-- b --> ^<!-- c ->\n</a>",
         "comment is not closed"},
        {"a comment in a tag", "<a>^<b <!-- no --> x=\"1\"/></a>", "tag <b is not closed"},
        {"CDATA that is not closed", "<a>^<![CDATA[ x\n</a>", "CDATA section is not closed"},
        {"a declaration that is not closed", "^<?xml version=\"1.0\"\n<a/>",
         "declaration is not closed"},
        {"a document type that is not closed", "^<!DOCTYPE a [ <!ELEMENT a>\n<a/>",
         "document type is not closed"},
        {"a less-than sign", "<a> 1 ^< 2 </a>", "'<' starts no element"},
        {"a tag that starts with a digit", "<a>^<2d/></a>", "'<' starts no element"},
        {"a less-than sign at the end", "<a/>^<", "'<' starts no element"},
        {"carriage returns", "<a>\r\n\t<b x=^\"1/>\r\n</a>\r\n", "quote is not closed"},
        {"UTF-16", "^\xff\xfe<", "UTF-16"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        // The last mark is where it is told.
        const MarkedText marked(row.text);
        Diagnostics diagnostics;
        CHECK(parse(marked.text, diagnostics) == nullptr);
        REQUIRE(diagnostics.all().size() == 1);
        const Diagnostic d = diagnostics.all().front();
        CHECK(d.code == "xml-syntax");
        CAPTURE(d.message);
        CHECK(d.message.find(row.message) != std::string::npos);
        CHECK(lineAndColumn(d.place) == marked.places.back());
    }
}

TEST_CASE("characters that XML has no place for in a value are taken as they are, and told") {
    struct Row {
        std::string name;
        const char* text; // '^' marks the places
        const char* value;
    };
    const Row rows[] = {
        {"markup", "<a x=\"^<c d='>'\"/>", "<c d='>'"},
        {"a comparison", "<a x='1 ^< 2 ^<= 3'/>", "1 < 2 <= 3"},
        {"an ampersand", "<a x=\"salt ^& pepper\"/>", "salt & pepper"},
        {"an entity without its end", "<a x=\"^&lt\"/>", "&lt"},
        {"an entity that nobody knows", "<a x=\"^&copy;\"/>", "&copy;"},
        {"an empty entity", "<a x=\"^&;^&#;^&#x;\"/>", "&;&#;&#x;"},
        {"an ampersand at the end", "<a x=\"^&\"/>", "&"},
        {"entities", "<a x=\"&lt;&gt;&amp;&quot;&apos;&#65;&#x42;\"/>", "<>&\"'AB"},
        {"in another element", "<a x='1'>\n<b/><c y='^&'/></a>", "1"},
        {"outside of values", "<!-- < & --><a x='1'> & </a>", "1"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const MarkedText marked(row.text);
        Diagnostics diagnostics;
        const auto document = parse(marked.text, diagnostics);
        REQUIRE(document);
        CHECK(document->root().attribute("x") == row.value);
        CHECK(diagnostics.errors() == 0);
        CHECK(problems(diagnostics) ==
              expected(marked, std::vector<std::string>(marked.places.size(), "xml-character")));
    }
}

TEST_CASE("a zero byte is no text") {
    Diagnostics diagnostics;
    CHECK(parse(std::string("<a>\n<b/>\0</a>", 13), diagnostics) == nullptr);
    CHECK(problems(diagnostics) == std::vector<std::string>{"xml-syntax 2:5"});
}

TEST_CASE("what follows the root element is ignored with a warning") {
    Diagnostics diagnostics;
    const auto document = parse("<a/>\n<!-- more -->\n <b/>\n<c/>", diagnostics);
    REQUIRE(document);
    CHECK(document->root().tag() == "a");
    CHECK(problems(diagnostics) == std::vector<std::string>{"extra-root 3:2"});
    CHECK(diagnostics.errors() == 0);
}

TEST_CASE("a document cut anywhere is refused or read, never more") {
    const std::string text =
        "\xef\xbb\xbf<!-- c -- --><?xml version='1.0'?><!DOCTYPE a [<!ENTITY b 'c'>]>\r\n"
        "<a x=\"1 &lt;\" y='2'>\r\n <b/><![CDATA[x]]> t &amp;<c\n z=\"\"\n></c></a>\n";
    for (std::size_t length = 0; length < text.size(); ++length) {
        CAPTURE(length);
        Diagnostics diagnostics;
        const auto document = parse(text.substr(0, length), diagnostics);
        CHECK((document == nullptr) == (diagnostics.errors() == 1));
        for (const Diagnostic& d : diagnostics.all())
            CHECK(d.place.offset <= length);
        // Only the line break at the end can be missed.
        CHECK((document == nullptr) == (length < text.size() - 1));
    }
}

TEST_CASE("a syntax error is found wherever a byte is wrong") {
    const std::string text = "<a x=\"1\" y='2'><b/><!-- c --><c z=\"\"></c>\n<d>t</d></a>";
    for (std::size_t at = 0; at < text.size(); ++at) {
        for (const char wrong :
             {'<', '>', '"', '\'', '/', '&', '=', ' ', '\n', 'x', '\0', '\xff'}) {
            std::string changed = text;
            changed[at] = wrong;
            Diagnostics diagnostics;
            const auto document = parse(changed, diagnostics);
            CHECK((document == nullptr) == (diagnostics.errors() == 1));
            if (!document) continue;
            for (const XmlElement& child : document->root().children()) {
                for (const XmlAttribute& attribute : child.attributes())
                    CHECK(attribute.valuePlace.offset <= text.size());
            }
        }
    }
}
