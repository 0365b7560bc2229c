// SPDX-License-Identifier: BSD-3-Clause
#include "temporary_folder.h"
#include "terrain/terrain_resource.h"

#include "resource/manager.h"
#include "terrain/terrain_node.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace terrane;

namespace {

// An archive of one terrain, loaded.
class Loaded {
public:
    explicit Loaded(const std::string& attributes) {
        declareTerrainNode(registry_);
        library_.emplace(SearchPath(), diagnostics);
        library_->addArchive(
            folder_.file("archive.xml", "<archive>\n<terrainNode name=\"ground\" " + attributes +
                                            "/>\n</archive>\n"));
        manager_.emplace(registry_, *library_, diagnostics);
        terrain = manager_->get<TerrainNode>("ground").get();
    }

    Diagnostics diagnostics;
    TerrainNode* terrain = nullptr;

private:
    test::TemporaryFolder folder_;
    Registry registry_;
    std::optional<Library> library_;
    std::optional<ResourceManager> manager_;
};

} // namespace

TEST_CASE("A terrain is built from what its element says") {
    const Loaded all("size=\"1000\" zmin=\"-10\" zmax=\"20.5\" deform=\"cylinder\" radius=\"800\" "
                     "splitFactor=\"2.5\" maxLevel=\"16\" horizonCulling=\"false\"");
    REQUIRE(all.terrain);
    CHECK(all.diagnostics.all().empty());
    const TerrainNode::Parameters& p = all.terrain->parameters();
    CHECK(p.size == 1000);
    CHECK(p.zmin == -10);
    CHECK(p.zmax == 20.5);
    CHECK(p.deformation->radius() == 800);
    CHECK(p.splitFactor == 2.5);
    CHECK(p.maxLevel == 16);
    CHECK_FALSE(p.horizonCulling);
    CHECK(all.terrain->root().l == 2000);

    const Loaded least("size=\"50\" splitFactor=\"2\" maxLevel=\"0\"");
    REQUIRE(least.terrain);
    CHECK(least.diagnostics.all().empty());
    CHECK(least.terrain->parameters().zmin == 0);
    CHECK(least.terrain->parameters().zmax == 0);
    CHECK(least.terrain->parameters().horizonCulling);
    CHECK(least.terrain->deformation().radius() == 0);

    const Loaded planet("size=\"6360000\" deform=\"sphere\" splitFactor=\"2\" maxLevel=\"16\" "
                        "horizonCulling=\"perhaps\"");
    REQUIRE(planet.terrain);
    CHECK(planet.terrain->deformation().radius() == 6360000);
    CHECK(planet.terrain->parameters().horizonCulling); // anything but "false"
}

TEST_CASE("Each way to be wrong has its diagnostic at its place") {
    struct Row {
        const char* attributes;
        Severity severity;
        const char* code;
        int column;
    };
    const int after = static_cast<int>(std::string("<terrainNode name=\"ground\" ").size()) + 1;
    for (const Row& row : std::vector<Row>{
             {"splitFactor=\"2\" maxLevel=\"9\"", Severity::error, "missing-attribute", 1},
             {"size=\"5\" splitFactor=\"2\"", Severity::error, "missing-attribute", 1},
             {"size=\"5\" maxLevel=\"9\"", Severity::error, "missing-attribute", 1},
             {"size=\"0\" splitFactor=\"2\" maxLevel=\"9\"", Severity::error, "out-of-range",
              after + 6},
             {"size=\"-5\" splitFactor=\"2\" maxLevel=\"9\"", Severity::error, "out-of-range",
              after + 6},
             {"size=\"nan\" splitFactor=\"2\" maxLevel=\"9\"", Severity::error, "out-of-range",
              after + 6},
             {"size=\"big\" splitFactor=\"2\" maxLevel=\"9\"", Severity::error, "wrong-kind",
              after + 6},
             {"maxLevel=\"-1\" size=\"5\" splitFactor=\"2\"", Severity::error, "out-of-range",
              after + 10},
             {"maxLevel=\"31\" size=\"5\" splitFactor=\"2\"", Severity::warning, "out-of-range",
              after + 10},
             {"splitFactor=\"1\" maxLevel=\"9\" size=\"5\"", Severity::warning, "out-of-range",
              after + 13},
             {"deform=\"torus\" size=\"5\" splitFactor=\"2\" maxLevel=\"9\"", Severity::warning,
              "unknown-word", after + 8},
             {"zmin=\"9\" size=\"5\" splitFactor=\"2\" maxLevel=\"9\"", Severity::warning,
              "out-of-range", after + 6},
             {"deform=\"cylinder\" size=\"5\" splitFactor=\"2\" maxLevel=\"9\"", Severity::error,
              "missing-attribute", 1},
             {"radius=\"0\" size=\"5\" splitFactor=\"2\" maxLevel=\"9\"", Severity::error,
              "out-of-range", after + 8},
             {"level=\"0\" size=\"5\" splitFactor=\"2\" maxLevel=\"9\"", Severity::error,
              "unknown-attribute", after},
         }) {
        CAPTURE(row.attributes);
        const Loaded loaded(row.attributes);
        const std::vector<Diagnostic> all = loaded.diagnostics.all();
        REQUIRE(all.size() == 1);
        CAPTURE(toString(all[0]));
        CHECK(all[0].severity == row.severity);
        CHECK(all[0].code == row.code);
        CHECK(all[0].place.position().line == 2);
        CHECK(all[0].place.position().column == row.column);
        CHECK((loaded.terrain != nullptr) == (row.severity == Severity::warning));
    }
}

TEST_CASE("A shape that nobody knows is a plain") {
    const Loaded loaded("deform=\"torus\" size=\"5\" splitFactor=\"2\" maxLevel=\"9\"");
    REQUIRE(loaded.terrain);
    CHECK(loaded.terrain->deformation().radius() == 0);
}

TEST_CASE("Elevation bounds in the wrong order are exchanged") {
    const Loaded loaded("zmin=\"9\" zmax=\"-2\" size=\"5\" splitFactor=\"2\" maxLevel=\"9\"");
    REQUIRE(loaded.terrain);
    CHECK(loaded.terrain->root().zmin == -2);
    CHECK(loaded.terrain->root().zmax == 9);
}
