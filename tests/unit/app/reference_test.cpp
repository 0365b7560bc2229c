// SPDX-License-Identifier: BSD-3-Clause
// What is made from the declarations and checked in is as they make it now.
#include "resource/manual_writer.h"
#include "resource/parser.h"
#include "resource/rnc_writer.h"
#include "resource/schema.h"
#include "resource/xsd_writer.h"

#include "archive_folder.h"
#include "core/files.h"

#include <doctest/doctest.h>

#include <cctype>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

using namespace terrane;
namespace fs = std::filesystem;

namespace {

void compare(const fs::path& file, const std::string& expected) {
    CAPTURE(file);
    const bool fresh = readFile(file).value_or("") == expected;
    CHECK_MESSAGE(fresh, "run tools/update-reference, and look at what changed");
}

// Where links into a page may lead: what GitHub makes of its headings.
std::set<std::string> anchorsOf(const std::string& page) {
    std::set<std::string> anchors;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("#")) continue;
        std::string anchor;
        for (const char c : line.substr(line.find(' ') + 1)) {
            if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
                anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            else if (c == ' ')
                anchor += '-';
        }
        CAPTURE(line);
        CHECK(anchors.insert(anchor).second);
    }
    return anchors;
}

} // namespace

TEST_CASE("the reference manual and the schemas are not older than the declarations") {
    const char* const source = std::getenv("TERRANE_SOURCE");
    if (!source) return;
    const Schema schema(standardRegistry());
    const fs::path schemas = fs::path(source) / "resources" / "schema";
    compare(schemas / "terrane.xsd", writeXsd(schema));
    compare(schemas / "terrane.rnc", writeRnc(schema));
    const fs::path manual = fs::path(source) / "docs" / "reference";
    std::set<fs::path> pages;
    for (const ManualPage& page : writeManual(schema)) {
        compare(manual / page.file, page.text);
        pages.insert(page.file);
    }
    for (const auto& entry : fs::directory_iterator(manual)) {
        CAPTURE(entry.path());
        CHECK(pages.contains(entry.path().filename()));
    }
}

TEST_CASE("every link of the reference manual leads somewhere") {
    std::map<std::string, std::set<std::string>> anchors;
    std::map<std::string, std::string> texts;
    for (const ManualPage& page : writeManual(Schema(standardRegistry()))) {
        anchors[page.file] = anchorsOf(page.text);
        texts[page.file] = page.text;
    }
    int links = 0;
    for (const auto& [file, text] : texts) {
        for (std::size_t at = text.find("]("); at != std::string::npos;
             at = text.find("](", at + 2)) {
            const std::string link = text.substr(at + 2, text.find(')', at) - at - 2);
            const std::size_t hash = link.find('#');
            const std::string page = hash == 0 ? file : link.substr(0, hash);
            CAPTURE(file);
            CAPTURE(link);
            CHECK(anchors.contains(page));
            if (hash != std::string::npos) CHECK(anchors[page].contains(link.substr(hash + 1)));
            ++links;
        }
    }
    CHECK(links > 300);
}

TEST_CASE("the examples of the reference manual work") {
    const auto check = [](const ElementDeclaration& declaration) {
        if (declaration.example.empty()) return;
        CAPTURE(declaration.example);
        const auto text = std::make_shared<SourceFile>(
            "example", "<archive>" + declaration.example + "</archive>");
        Diagnostics diagnostics;
        const auto document = XmlDocument::parse(text, diagnostics);
        REQUIRE(document);
        bool shown = false;
        for (const XmlElement& entry : document->root().children()) {
            const ElementDeclaration* d = standardRegistry().find(entry.tag());
            if (!d) d = standardRegistry().findTopLevel(entry.tag());
            REQUIRE(d);
            parseElement(entry, *d, standardRegistry(), diagnostics);
            shown |= d == &declaration;
        }
        std::string told;
        for (const Diagnostic& d : diagnostics.all())
            told += toString(d);
        CHECK(told == "");
        CHECK(shown);
    };
    for (const std::string& tag : standardRegistry().tags())
        check(*standardRegistry().find(tag));
    for (const ElementDeclaration* declaration : standardRegistry().topLevels())
        check(*declaration);
}
