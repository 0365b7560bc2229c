// SPDX-License-Identifier: BSD-3-Clause
#include "app/check.h"

#include "archive_folder.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <string>

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
