// SPDX-License-Identifier: BSD-3-Clause
#include "edited_archive.h"
#include "producer/tile_producer.h"
#include "resource/manager.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

using namespace terrane;

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
        archive.paintTint(20, 60, 220);
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
            CHECK(archive.problems() == edit->outcome);
            CHECK(samePicture(archive.picture(), before));
            archive.write(row.good.file, original);
            CHECK(player.reload().good);
            CHECK(player.diagnostics().errors() == 0);
            CHECK(samePicture(archive.picture(), before));
        }
        apply(archive, row.good, false);
        const ReloadReport good = player.reload();
        for (const Diagnostic& diagnostic : player.problems())
            FAIL_CHECK(toString(diagnostic));
        CHECK(listed(good.rebuilt) == row.good.outcome);
        CHECK(samePicture(archive.picture(), archive.freshPicture()));
        archive.write(row.good.file, original);
        CHECK(player.reload().good);
        CHECK(samePicture(archive.picture(), before));
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
    CHECK(samePicture(archive.picture(), before));
}
