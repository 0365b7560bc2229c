// SPDX-License-Identifier: BSD-3-Clause
#include "app/check.h"

#include "archive_folder.h"
#include "core/files.h"
#include "core/text.h"

#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

using namespace terrane;

TEST_CASE("check tells everything that is wrong, in the order of the file") {
    ArchiveFolder folder;
    folder.write("archive.xml", R"(<archive>
  <program name="b"><module name="missing"/></program>
  <terrainNode name="t" size="x" splitFactor="2" maxLevel="3"/>
  <sequense name="c"/>
  <tweakBar name="bar"/>
</archive>)");
    const auto found = checkArchive(standardRegistry(), folder.path(), {});
    const DiagnosticCounts counts = count(found);
    CHECK(counts.warnings == 1);
    CHECK(counts.toString() == std::to_string(counts.errors) + " errors, 1 warning");
    std::string codes;
    int line = 0;
    for (const Diagnostic& diagnostic : found) {
        codes += diagnostic.code + " ";
        CHECK(diagnostic.place.position().line >= line);
        line = diagnostic.place.position().line;
    }
    REQUIRE(codes == "unknown-resource wrong-kind unknown-element not-built-yet ");
    const auto json = nlohmann::json::parse(toJson(found));
    REQUIRE(json.size() == found.size());
    CHECK(json[2]["suggestion"] == "sequence");
    CHECK(json[2]["line"] == 4);
    CHECK(json[2]["column"] == 3);
    CHECK(json[3]["severity"] == "warning");
}

TEST_CASE("check finds archives that are not there") {
    const auto found = checkArchive(standardRegistry(), "/nowhere/at/all", {});
    REQUIRE(found.size() == 1);
    CHECK(found[0].code == "no-archive");
}

TEST_CASE("check tells what nothing that is played uses, when it is asked") {
    ArchiveFolder folder;
    folder.writeColour("1, 0, 0");
    const auto before = checkArchive(standardRegistry(), folder.path(), {}, true);
    CHECK(before.empty());
    std::string text = readFile(folder.path() / "archive.xml").value_or("");
    text.insert(text.rfind("</archive>"), "\n<node name=\"forgotten\"/>\n");
    folder.write("archive.xml", text);
    CHECK(checkArchive(standardRegistry(), folder.path(), {}).empty());
    const auto found = checkArchive(standardRegistry(), folder.path(), {}, true);
    REQUIRE(found.size() == 1);
    CHECK(found[0].code == "unused-resource");
    CHECK(found[0].severity == Severity::warning);
    CHECK(found[0].place.position().column == 1);
}

TEST_CASE("check counts what is skipped for data that is not prepared") {
    ArchiveFolder folder;
    folder.write("prepare", "# makes: relief.png\n");
    folder.write("archive.xml", R"(<archive>
  <texture2D name="t" source="relief.png" internalformat="RGBA8"/>
</archive>)");
    const auto found = checkArchive(standardRegistry(), folder.path(), {});
    CHECK(count(found).toString() == "0 errors, 0 warnings, 1 skipped: data not prepared");
    const auto json = nlohmann::json::parse(toJson(found));
    REQUIRE(json.size() == 1);
    CHECK(json[0]["severity"] == "note");
}

TEST_CASE("diagnostics are sorted in one way, whoever came first") {
    const auto a = std::make_shared<SourceFile>("a.xml", "12345");
    const auto b = std::make_shared<SourceFile>("b.xml", "12345");
    const std::vector<Diagnostic> sorted{
        {.code = "z", .message = "m"},
        {.code = "z", .place = {a, 1}, .message = "m"},
        {.code = "b", .place = {a, 3}, .message = "m"},
        {.code = "b", .place = {a, 3}, .message = "n"},
        {.code = "c", .place = {a, 3}, .message = "a"},
        {.code = "a", .place = {b, 0}, .message = "m"},
    };
    std::vector<std::size_t> order{0, 1, 2, 3, 4, 5};
    do {
        std::vector<Diagnostic> list;
        for (const std::size_t i : order)
            list.push_back(sorted[i]);
        sortByPlace(list);
        for (std::size_t i = 0; i < list.size(); ++i) {
            const bool same = list[i].code == sorted[i].code && list[i].place == sorted[i].place &&
                              list[i].message == sorted[i].message;
            REQUIRE(same);
        }
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("the keys of the JSON are those that docs/diagnostics.md lists") {
    const char* const source = std::getenv("TERRANE_SOURCE");
    if (!source) {
        MESSAGE("skipped: TERRANE_SOURCE is not set");
        return;
    }
    const auto page = readFile(std::filesystem::path(source) / "docs" / "diagnostics.md");
    REQUIRE(page);
    const std::size_t begin = page->find("| Key |");
    const std::string table = page->substr(begin, page->find("\n\n", begin) - begin);
    std::set<std::string> listed;
    for (const std::string_view row : split(table, '\n')) {
        const std::string cell(split(row, '|').at(1));
        static const std::regex key("`([a-z]+)`");
        for (std::sregex_iterator match(cell.begin(), cell.end(), key), end; match != end; ++match)
            listed.insert((*match)[1]);
    }
    const auto file = std::make_shared<SourceFile>("a.xml", "1");
    const Diagnostic all{.code = "c",
                         .place = {file, 0},
                         .message = "m",
                         .expected = "e",
                         .suggestion = "s",
                         .detail = "d",
                         .chain = {"n"}};
    std::set<std::string> written;
    const auto json = nlohmann::json::parse(toJson({all}));
    for (const auto& item : json[0].items())
        written.insert(item.key());
    CHECK(written == listed);
}
