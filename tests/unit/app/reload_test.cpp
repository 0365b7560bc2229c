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

std::string listed(const Names& names) {
    std::string text;
    for (const std::string& name : names)
        text += name + " ";
    return text;
}

/// Tiles that each producer has made since the last mark.
Counts made(Player& player) {
    Counts counts;
    for (const char* name : EditedArchive::kProducers)
        counts[name] = static_cast<int>(player.counters().tiles(*player.resources(), name));
    return counts;
}

bool same(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.bytes == b.bytes;
}

std::string codes(Player& player) {
    std::string text;
    for (const Diagnostic& d : player.problems())
        text += d.code + " ";
    return text;
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

void paintTint(EditedArchive& archive, unsigned char r, unsigned char g, unsigned char b) {
    REQUIRE(writePng(archive.path() / "tint.png",
                     Image{.width = 1, .height = 1, .channels = 3, .bytes = {r, g, b}}));
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
        {"a texture", [](auto& a) { paintTint(a, 90, 200, 60); }, {"tint"}, {}},
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
        CHECK(same(after, before) == !row.seen);
        CHECK(same(after, archive.freshPicture()));
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
        CHECK(codes(player) == row.problems);
        CHECK(player.diagnostics().errors() > 0);
        CHECK(player.frame());
        CHECK(same(archive.picture(), before));
        for (const auto& [name, count] : made(player))
            CHECK(count == 0);

        archive.write(row.file, good);
        const ReloadReport mended = player.reload();
        CHECK(mended.good);
        CHECK_FALSE(mended.changed);
        CHECK(codes(player).empty());
        CHECK(player.diagnostics().errors() == 0);
        CHECK(same(archive.picture(), before));
        CHECK(player.metrics()["memory"]["gl_objects"] == objects);
    }
}

namespace {

/// A text of a file, and what stands there instead.
struct TextEdit {
    std::string file, before, after;
    std::string outcome =
        {}; ///< what a good edit rebuilds, or the codes of the errors of a bad one
};

struct TypeEdits {
    std::string type;
    TextEdit good, bad, removal;
};

const TypeEdits kTypes[] = {
    {"module",
     {"archive.xml", "source=\"sky.glsl\"", "source=\"sky.glsl\" options=\"A 1\"", "sky sky; "},
     {"archive.xml", "version=\"330\" source=\"sky.glsl\"", "version=\"x\" source=\"sky.glsl\"",
      "wrong-kind "},
     {"archive.xml", "<module name=\"sky\" version=\"330\" source=\"sky.glsl\"/>", "",
      "unknown-resource "}},
    {"file of a module",
     {"sky.glsl", "0.4, 0.6", "0.6, 0.4", "sky sky; "},
     {"sky.glsl", "vec4(0.4", "vec5(0.4", "glsl-compile "},
     {"sky.glsl", "", "", "file-missing "}},
    {"program",
     {"archive.xml", "<module name=\"branchShader\"/></program>",
      "<module name=\"upsampleShader\"/></program>", "branch branchProgram scene "},
     {"archive.xml", "<module name=\"branchShader\"/></program>",
      "<module name=\"tint\"/></program>", "mistyped-reference "},
     {"archive.xml", "<program name=\"branchProgram\"><module name=\"branchShader\"/></program>",
      "", "unknown-resource "}},
    {"texture",
     {"archive.xml", "internalformat=\"RGBA8\" min=\"NEAREST\"",
      "internalformat=\"RGB8\" min=\"NEAREST\"", "tint "},
     {"archive.xml", "internalformat=\"RGBA8\" min=\"NEAREST\"",
      "internalformat=\"RGBA88\" min=\"NEAREST\"", "unknown-word "},
     {"archive.xml", "<texture2D name=\"tint\"", "<texture2D name=\"other\"", "unknown-resource "}},
    {"file of a texture",
     {"tint.png", "", "<other>", "tint "},
     {"tint.png", "IHDR", "IDHR", "image-damaged "},
     {"tint.png", "", "", "file-missing "}},
    {"mesh",
     {"whole.mesh", "-1 1 0  1 1 0", "-1 1 0  2 2 0", "whole.mesh "},
     {"whole.mesh", "trianglestrip", "triangelstrip", "mesh-syntax "},
     {"whole.mesh", "", "", "file-missing "}},
    {"font",
     {"archive.xml", "invalidChar=\"63\"", "invalidChar=\"64\"", "drawFrame letters "},
     {"archive.xml", "nCols=\"16\"", "nCols=\"0\"", "out-of-range "},
     {"archive.xml", "<font name=\"letters\"", "<font name=\"other\"", "unknown-resource "}},
    {"node",
     {"archive.xml", "<bounds xmin=\"-400\"", "<translate z=\"5\"/><bounds xmin=\"-400\"",
      "scene "},
     {"archive.xml", "<bounds xmin=\"-400\"", "<bounds xmn=\"-400\"",
      "unknown-attribute missing-attribute "},
     {"archive.xml", "flags=\"camera\"", "flags=\"\"", "no-camera "}},
    {"method",
     {"archive.xml", "<method id=\"update\" value=\"updateGround\"/>",
      "<method id=\"update\" value=\"updateGround\" enabled=\"true\"/>", "scene "},
     {"archive.xml", "<method id=\"update\" value=\"updateGround\"/>",
      "<method id=\"update\" value=\"paint\"/>", "mistyped-reference "},
     {"archive.xml", "<method id=\"update\" value=\"updateGround\"/>", "", "missing-method "}},
    {"task",
     {"archive.xml", "<drawMesh name=\"whole\"/>", "<drawMesh name=\"whole\" count=\"1\"/>",
      "drawFrame "},
     {"archive.xml", "<drawMesh name=\"whole\"/>", "<drawMehs name=\"whole\"/>",
      "unknown-element "},
     {"archive.xml", "<sequence name=\"drawGround\">", "<sequence name=\"other\">",
      "unknown-resource "}},
    {"storage",
     {"archive.xml", "nTiles=\"500\"", "nTiles=\"450\"",
      "elevationCache elevationStorage elevations normals scene "},
     {"archive.xml", "nTiles=\"500\"", "nTiles=\"0\"", "out-of-range "},
     {"archive.xml", "<gpuTileStorage name=\"elevationStorage\"", "<gpuTileStorage name=\"other\"",
      "unknown-resource "}},
    {"storage in a cache",
     {"archive.xml", "capacity=\"60\"", "capacity=\"50\"",
      "elevations normals residualCache residuals scene "},
     {"archive.xml", "cpuFloatTileStorage", "cpuFlaotTileStorage", "unknown-element "},
     {"archive.xml", "<cpuFloatTileStorage tileSize=\"29\" channels=\"1\" capacity=\"60\"/>", "",
      "missing-element "}},
    {"cache",
     {"archive.xml", "<tileCache name=\"branchCache\" scheduler=\"scheduler\">",
      "<tileCache name=\"branchCache\" scheduler=\"scheduler2\">", "branch branchCache scene "},
     {"archive.xml", "<tileCache name=\"branchCache\" scheduler=\"scheduler\">",
      "<tileCache name=\"branchCache\">", "missing-attribute "},
     {"archive.xml", "<tileCache name=\"branchCache\"", "<tileCache name=\"other\"",
      "unknown-resource "}},
    {"scheduler",
     {"archive.xml", "nthreads=\"2\"", "nthreads=\"3\"",
      "branch branchCache elevationCache elevations normalCache normals residualCache residuals "
      "scene scheduler "},
     {"archive.xml", "nthreads=\"2\"", "nthreads=\"two\"", "wrong-kind "},
     {"archive.xml", "<multithreadScheduler name=\"scheduler\"",
      "<multithreadScheduler name=\"other\"",
      "unknown-resource unknown-resource unknown-resource unknown-resource "}},
    {"residual producer",
     {"archive.xml", "file=\"DEM.dat\" delta=\"1\"", "file=\"DEM.dat\" delta=\"1\" scale=\"2\"",
      "elevations normals residuals scene "},
     {"archive.xml", "file=\"DEM.dat\" delta=\"1\"", "file=\"DEM.dat\" delta=\"2\"",
      "out-of-range "},
     {"archive.xml", "<residualProducer name=\"residuals\"", "<residualProducer name=\"other\"",
      "unknown-resource "}},
    {"elevation producer",
     {"archive.xml", "noise=\"0,3,2,1,4,2\"", "noise=\"0,30,2,1,4,2\"",
      "elevations normals scene "},
     {"archive.xml", "noise=\"0,3,2,1,4,2\"", "noise=\"0,x,2,1,4,2\"", "wrong-kind "},
     {"archive.xml", "<elevationProducer name=\"elevations\"", "<elevationProducer name=\"other\"",
      "unknown-resource unknown-resource "}},
    {"normal producer",
     {"archive.xml", "<normalProducer name=\"normals\"",
      "<normalProducer gridSize=\"12\" name=\"normals\"", "normals scene "},
     {"archive.xml", "<normalProducer name=\"normals\"",
      "<normalProducer gridSize=\"7\" name=\"normals\"", "wrong-grid-size "},
     {"archive.xml", "<normalProducer name=\"normals\"", "<normalProducer name=\"other\"",
      "unknown-resource "}},
    {"sampler",
     {"archive.xml", "producer=\"normals\"", "producer=\"normals\" storeInvisible=\"false\"",
      "scene "},
     {"archive.xml", "producer=\"normals\"", "producer=\"tint\"", "mistyped-reference "},
     {"archive.xml", "producer=\"normals\"", "", "missing-attribute "}},
    {"terrain",
     {"archive.xml", "splitFactor=\"2\"", "splitFactor=\"1.5\"", "relief "},
     {"archive.xml", "splitFactor=\"2\"", "splitFactor=\"\"", "wrong-kind "},
     {"archive.xml", "<terrainNode name=\"relief\"", "<terrainNode name=\"other\"",
      "unknown-resource "}},
    {"player",
     {"archive.xml", "<player>", "<player scheduler=\"scheduler\">", ""},
     {"archive.xml", "<player>", "<player root=\"nobody\">", "unknown-resource "},
     {"archive.xml", "<player>", "<player camera=\"nobody\">", "no-camera "}},
};

void apply(EditedArchive& archive, const TextEdit& edit, bool removal) {
    if (edit.before.empty() && removal)
        archive.remove(edit.file);
    else if (edit.before.empty())
        paintTint(archive, 20, 60, 220);
    else
        archive.edit(edit.file, edit.before, edit.after);
}

} // namespace

TEST_CASE("resources of every type follow good edits, and stand bad ones and removals") {
    for (const TypeEdits& row : kTypes) {
        CAPTURE(row.type);
        EditedArchive archive;
        Player& player = archive.open();
        const Image before = archive.picture();
        const auto objects = player.metrics()["memory"]["gl_objects"];
        const std::string original = archive.read(row.good.file);
        for (const TextEdit* edit : {&row.bad, &row.removal}) {
            CAPTURE(edit->outcome);
            apply(archive, *edit, edit == &row.removal);
            CHECK_FALSE(player.reload().good);
            CHECK(codes(player) == edit->outcome);
            CHECK(same(archive.picture(), before));
            archive.write(row.good.file, original);
            CHECK(player.reload().good);
            CHECK(player.diagnostics().errors() == 0);
            CHECK(same(archive.picture(), before));
        }
        apply(archive, row.good, false);
        const ReloadReport good = player.reload();
        for (const Diagnostic& diagnostic : player.problems())
            FAIL_CHECK(toString(diagnostic));
        CHECK(listed(good.rebuilt) == row.good.outcome);
        CHECK(same(archive.picture(), archive.freshPicture()));
        archive.write(row.good.file, original);
        CHECK(player.reload().good);
        CHECK(same(archive.picture(), before));
        CHECK(player.metrics()["memory"]["gl_objects"] == objects);
    }
}

TEST_CASE("a reload does not mind that workers make tiles of what it replaces") {
    EditedArchive archive;
    Player& player = archive.open();
    const Image before = archive.picture();
    const std::string original = archive.read("archive.xml");
    const auto busy = [&] {
        const auto residuals = player.resources()->get<TileProducer>("residuals");
        for (int level = 2; level < 5; ++level)
            for (int i = 0; i < 4; ++i)
                residuals->prefetchTile({level, i, i / 2});
    };
    for (int i = 0; i < 20; ++i) {
        CAPTURE(i);
        busy();
        switch (i % 4) {
        case 0:
            archive.edit("archive.xml", "delta=\"1\"", "delta=\"1\" scale=\"2\"");
            break;
        case 1:
            archive.edit("archive.xml", "capacity=\"60\"", "capacity=\"50\"");
            break;
        case 2:
            archive.edit("archive.xml", "nthreads=\"2\"", "nthreads=\"1\"");
            break;
        default:
            archive.edit("archive.xml", "nthreads=\"2\"", "nthreads=\"none\"");
            break;
        }
        CHECK(player.reload().good == (i % 4 != 3));
        CHECK(player.frame());
        busy();
        archive.write("archive.xml", original);
        CHECK(player.reload().good);
        CHECK(player.frame());
    }
    CHECK(same(archive.picture(), before));
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
