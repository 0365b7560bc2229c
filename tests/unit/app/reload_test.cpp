// SPDX-License-Identifier: BSD-3-Clause
#include "edited_archive.h"
#include "producer/tile_producer.h"
#include "resource/manager.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

using namespace terrane;

namespace {

using Names = std::vector<std::string>;
using Counts = std::map<std::string, int>;

/// Tiles that each producer has made since the last mark.
Counts made(Player& player) {
    Counts counts;
    for (const char* name : EditedArchive::kProducers)
        counts[name] = static_cast<int>(player.counters().tiles(*player.resources(), name));
    return counts;
}

/// Twice as high.
void raise(EditedArchive& archive) {
    constexpr std::size_t kScale = 24; // its offset (terrain reference 4.1)
    std::string bytes = archive.read("DEM.dat");
    float scale = 0;
    std::memcpy(&scale, &bytes[kScale], sizeof scale);
    scale *= 2;
    std::memcpy(&bytes[kScale], &scale, sizeof scale);
    archive.write("DEM.dat", bytes);
}

} // namespace

TEST_CASE("an edit rebuilds what depends on it, and makes exactly those tiles anew") {
    struct Row {
        std::string name;
        std::function<void(EditedArchive&)> edit;
        Names rebuilt;
        Names invalidated; ///< producers all of whose tiles go
        bool seen = true;  ///< the picture differs
    };
    const Row rows[] = {
        {"the upsample shader",
         [](auto& a) {
             a.edit("upsample.glsl", "#ifdef _FRAGMENT_", "#define _NEW_\n#ifdef _FRAGMENT_");
         },
         {"elevations", "normals", "scene", "upsampleShader", "upsampleShader;"},
         {"elevations", "normals"},
         false},
        {"the normal shader",
         [](auto& a) {
             a.edit("normal.glsl", "#ifdef _FRAGMENT_", "#define _NEW_\n#ifdef _FRAGMENT_");
         },
         {"normalShader", "normalShader;", "normals", "scene"},
         {"normals"},
         false},
        {"the terrain shader",
         [](auto& a) { a.edit("paint.glsl", "0.35, 0.5, 0.25", "0.6, 0.5, 0.25"); },
         {"paint", "paint;"},
         {}},
        {"a comment of the archive",
         [](auto& a) { a.edit("archive.xml", "<archive>", "<archive>\n<!-- a comment -->\n"); },
         {},
         {},
         false},
        {"a comment of a shader",
         [](auto& a) {
             a.edit("upsample.glsl", "#ifdef _FRAGMENT_", "// a comment\n#ifdef _FRAGMENT_");
         },
         {},
         {},
         false},
        {"a node's flag",
         [](auto& a) {
             a.edit("archive.xml", "name=\"ground\" flags=\"object\"",
                    "name=\"ground\" flags=\"object,more\"");
         },
         {"scene"},
         {},
         false},
        {"the noise amplitude",
         [](auto& a) { a.edit("archive.xml", "0,3,2,1,4,2", "0,30,20,1,4,2"); },
         {"elevations", "normals", "scene"},
         {"elevations", "normals"}},
        {"that of the branch",
         [](auto& a) { a.edit("archive.xml", "10,5,3,2,1,1", "30,20,10,5,1,1"); },
         {"branch", "scene"},
         {"branch"}},
        {"the DEM file",
         [](auto& a) { raise(a); },
         {"elevations", "normals", "residuals", "scene"},
         {"elevations", "normals", "residuals"}},
        {"a texture", [](auto& a) { a.paintTint(90, 200, 60); }, {"tint"}, {}},
        {"an include used by one of two shaders",
         [](auto& a) { a.edit("common.glsl", "-0.7, 0.3", "0.7, -0.3"); },
         {"paint", "paint;"},
         {}},
        {"an initial value",
         [](auto& a) {
             a.edit("archive.xml", "name=\"warmth\" x=\"0.2\"", "name=\"warmth\" x=\"0.5\"");
         },
         {"paint", "paint;"},
         {}},
        {"the size of a storage",
         [](auto& a) { a.edit("archive.xml", "nTiles=\"500\"", "nTiles=\"600\""); },
         {"elevationCache", "elevationStorage", "elevations", "normals", "scene"},
         {"elevations", "normals"},
         false},
        {"the terrain",
         [](auto& a) { a.edit("archive.xml", "maxLevel=\"5\"", "maxLevel=\"1\""); },
         {"relief"},
         {},
         true},
        {"the scheduler",
         [](auto& a) { a.edit("archive.xml", "nthreads=\"2\"", "nthreads=\"1\""); },
         {"branch", "branchCache", "elevationCache", "elevations", "normalCache", "normals",
          "residualCache", "residuals", "scene", "scheduler"},
         {"branch", "elevations", "normals", "residuals"},
         false},
    };
    EditedArchive archive;
    Player& player = archive.open();
    Image before = archive.picture();
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const Counts there = [&] {
            Counts counts;
            for (const char* name : EditedArchive::kProducers) {
                const auto p = player.resources()->get<TileProducer>(name);
                counts[name] = p->cache().tilesOf(*p);
            }
            return counts;
        }();
        player.mark();
        row.edit(archive);
        const ReloadReport report = player.reload();
        for (const Diagnostic& diagnostic : player.problems())
            FAIL_CHECK(toString(diagnostic));
        CHECK(report.good);
        CHECK(report.changed == !row.rebuilt.empty());
        CHECK(listed(report.rebuilt) == listed(row.rebuilt));
        Counts expected;
        for (const std::string& name : row.invalidated)
            expected[name] = there.at(name);
        CHECK(report.tilesInvalidated == expected);

        const Image after = archive.picture();
        CHECK(samePicture(after, before) == !row.seen);
        CHECK(samePicture(after, archive.freshPicture()));
        const Counts again = made(player);
        for (const char* name : EditedArchive::kProducers) {
            CAPTURE(name);
            const bool reached = std::count(row.invalidated.begin(), row.invalidated.end(), name);
            CHECK((again.at(name) > 0) == reached);
            CHECK(again.at(name) <= there.at(name));
        }
        const auto metrics = player.metrics();
        CHECK(metrics["reloads"]["count"] == (report.changed ? 1 : 0));
        CHECK(metrics["reloads"]["resources"] == row.rebuilt.size());
        CHECK(metrics["reloads"]["tiles_invalidated"].size() == row.invalidated.size());
        before = after;
    }
    for (const Diagnostic& diagnostic : player.diagnostics().all())
        FAIL_CHECK(toString(diagnostic));
}

TEST_CASE(
    "a bad edit leaves the picture as it is, says what is wrong, and is forgotten when mended") {
    struct Row {
        std::string name;
        const char* file;
        const char* before;
        const char* after;
        std::string problems;
    };
    const Row rows[] = {
        {"a shader that does not compile", "paint.glsl", "vec2 slope = mix", "vec2 slope = mxi",
         "glsl-compile "},
        {"an include that is not there", "paint.glsl", "common.glsl", "commno.glsl",
         "include-missing "},
        {"an include with a mistake", "common.glsl", "vec3(", "vec3((", "glsl-compile "},
        {"an upsample shader", "upsample.glsl", "void main()", "void mian()", "glsl-link "},
        {"a truncated archive", "archive.xml", "</archive>", "", "xml-syntax "},
        {"an unknown attribute", "archive.xml",
         "maxLevel=", "maxLevle=", "unknown-attribute missing-attribute "},
        {"a wrong value", "archive.xml", "capacity=\"60\"", "capacity=\"many\"", "wrong-kind "},
        {"a name that is not there", "archive.xml", "value=\"paint\"", "value=\"pain\"",
         "unknown-resource "},
        {"a method that is not there", "archive.xml", "$g.draw", "$g.darw", "missing-method "},
        {"a field that is not there", "archive.xml", "updateTerrain name=\"this.terrain\"",
         "updateTerrain name=\"this.terrian\"", "missing-field "},
        {"a resource that is gone", "archive.xml",
         "<module name=\"sky\" version=\"330\" source=\"sky.glsl\"/>", "", "unknown-resource "},
        {"no root", "archive.xml", "<node name=\"scene\">", "<node name=\"secne\">", "no-root "},
        {"a tile size that does not fit", "archive.xml", "tileSize=\"25\"", "tileSize=\"26\"",
         "wrong-tile-size "},
        {"a pyramid that is none", "DEM.dat", "", "not a pyramid", "damaged-file "},
        {"a texture that is none", "tint.png", "PNG", "GNP", "image-damaged "},
        {"a mesh that is none", "whole.mesh", "4  -1", "9  -1", "mesh-syntax "},
    };
    EditedArchive archive;
    Player& player = archive.open();
    const Image before = archive.picture();
    const int objects = player.metrics()["memory"]["gl_objects"];
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const std::string good = archive.read(row.file);
        archive.edit(row.file, row.before, row.after);
        player.mark();
        const ReloadReport bad = player.reload();
        CHECK(bad.changed);
        CHECK_FALSE(bad.good);
        CHECK(archive.problems() == row.problems);
        CHECK(player.diagnostics().errors() > 0);
        CHECK(player.frame());
        CHECK(samePicture(archive.picture(), before));
        for (const auto& [name, count] : made(player))
            CHECK(count == 0);

        archive.write(row.file, good);
        const ReloadReport mended = player.reload();
        CHECK(mended.good);
        CHECK_FALSE(mended.changed);
        CHECK(archive.problems().empty());
        CHECK(player.diagnostics().errors() == 0);
        CHECK(samePicture(archive.picture(), before));
        CHECK(player.metrics()["memory"]["gl_objects"] == objects);
    }
}

TEST_CASE(
    "what went wrong while frames were drawn is forgotten when it is mended, and told in place") {
    EditedArchive archive;
    Player& player = archive.open();
    archive.edit("archive.xml", "nTiles=\"500\"", "nTiles=\"20\"");
    CHECK(player.reload().good);
    player.frame();
    CHECK(player.diagnostics().errors() > 0);
    CHECK(player.diagnostics().all().back().code == "cache-full");
    archive.edit("archive.xml", "nTiles=\"20\"", "nTiles=\"500\"");
    CHECK(player.reload().good);
    CHECK(player.drawUntilComplete());
    CHECK(player.diagnostics().errors() == 0);

    // The sampler stays, while lines come to stand above it.
    archive.edit("archive.xml", "<archive>", "<archive>\n<!-- one\nmore -->\n");
    CHECK_FALSE(player.reload().changed);
    archive.edit("archive.xml", "nTiles=\"500\"", "nTiles=\"501\"");
    CHECK(player.reload().good);
    player.controller().view.d = 10;
    archive.edit("archive.xml", "splitFactor=\"2\"", "splitFactor=\"40\"");
    CHECK(player.reload().rebuilt == Names{"relief"});
    player.frame();
    const std::vector<Diagnostic> all = player.diagnostics().all();
    REQUIRE(!all.empty());
    CHECK(all.back().code == "cache-full");
    const LineColumn at = all.back().place.position();
    const SourceFile now("archive.xml", archive.read("archive.xml"));
    CHECK(now.line(at.line).find("<tileSampler ") != std::string_view::npos);
}

TEST_CASE("a message shows the text that it is about, however often the file was saved") {
    EditedArchive archive;
    Player& player = archive.open();
    archive.edit("sky.glsl", "0.4, 0.6", "0.5, 0.6");
    archive.edit("archive.xml", "<archive>", "<archive>\n\n");
    CHECK(player.reload().good);
    struct Row {
        const char *file, *before, *after, *line;
    };
    const Row rows[] = {
        {"archive.xml", "maxLevel=\"5\"", "maxLevle=\"5\"", "maxLevle=\"5\""},
        {"archive.xml", "<normalProducer ", "<normalProduccer ", "<normalProduccer "},
        {"sky.glsl", "vec4(0.5", "vec4(x, 0.5", "vec4(x, 0.5"},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.after));
        const std::string good = archive.read(row.file);
        archive.edit(row.file, row.before, row.after);
        player.reload();
        const std::vector<Diagnostic> problems = player.problems();
        archive.write(row.file, good);
        CHECK(player.reload().good);
        REQUIRE(!problems.empty());
        const Place& place = problems.front().place;
        REQUIRE(place);
        CHECK(place.file->line(place.position().line).find(row.line) != std::string_view::npos);
    }
}
