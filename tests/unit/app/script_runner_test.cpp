// SPDX-License-Identifier: BSD-3-Clause
#include "app/script_runner.h"

#include "app/player.h"
#include "archive_folder.h"
#include "edited_archive.h"
#include "hills.h"

#include <doctest/doctest.h>

#include <string>

using namespace terrane;

TEST_CASE("whoever sees the frames of a command may stop it") {
    ArchiveFolder folder;
    folder.writeColour("0.0, 0.0, 1.0");
    Player player(standardRegistry(), {.archive = folder.path(), .width = 8, .height = 8});
    REQUIRE(player.load());
    std::string text;
    SUBCASE("frames") {
        text = "frames 1000";
    }
    SUBCASE("wait") {
        text = "wait tiles";
    }
    SUBCASE("camera") {
        text = "camera 0,0,0,0,10 to 1,1,0,0,10 in 1000 frames";
    }
    CAPTURE(text);
    int seen = 0;
    ScriptRunner runner(player, {}, [&](int, int) { return ++seen < 2; });
    const auto line = parseScriptLine(text, 1);
    REQUIRE(line);
    REQUIRE(line->problem == "");
    CHECK(runner.run(*line) == "stopped before its end");
    CHECK(player.frames() == 2);
}

namespace {

/// Runs lines; what the first one that fails says.
std::string runLines(ScriptRunner& runner, const std::string& text) {
    for (const ScriptLine& line : parseScript(text)) {
        const std::string problem = line.command ? runner.run(line) : line.problem;
        if (!problem.empty()) return problem;
    }
    return {};
}

} // namespace

TEST_CASE("scripts can do what a person does in the window") {
    Hills hills;
    Player& player = hills.player();
    REQUIRE(player.load());
    ScriptRunner runner(player, {});
    REQUIRE(runLines(runner, "camera 0,0,50,0,900\nframes 4") == "");
    const View start = player.controller().view;
    CHECK(runLines(runner, "wheel -1\nframes 1") == "");
    CHECK(player.controller().view.d == doctest::Approx(1.2 * start.d));
    CHECK(runLines(runner, "wheel 1\nkey pageup down\nframes 30\nkey pageup up") == "");
    const double farther = player.controller().view.d;
    CHECK(farther > 1.05 * start.d);
    CHECK(runLines(runner, "frames 5") == "");
    CHECK(player.controller().view.d == farther);
    CHECK(runLines(runner, "mouse move 80 60\nkey control down\nmouse down left\n"
                           "mouse move 60 70\nframes 1\nmouse up left\nkey control up") == "");
    CHECK(player.controller().view.phi != start.phi);
    const auto from = player.groundAt(80, 60), to = player.groundAt(90, 60);
    REQUIRE(from);
    REQUIRE(to);
    const View before = player.controller().view;
    CHECK(runLines(runner, "mouse move 80 60\nmouse down left\nmouse move 90 60\nframes 1\n"
                           "mouse up left\nframes 1") == "");
    CHECK(player.controller().view.x0 == doctest::Approx(before.x0 - (to->x - from->x)));
    CHECK(player.controller().view.y0 == doctest::Approx(before.y0 - (to->y - from->y)));
}

TEST_CASE("scripts set attributes, which count until the file says something else") {
    EditedArchive archive;
    Player& player = archive.open();
    const Image before = archive.picture();
    ScriptRunner runner(player, {});
    CHECK(runLines(runner, "mark\nset elevations.noise 0,30,2,1,4,2") == "");
    CHECK(archive.read("archive.xml").find("0,30,2") == std::string::npos); // the file stays
    const Image raised = archive.picture();
    CHECK(raised.bytes != before.bytes);
    CHECK(player.counters().tiles(*player.resources(), "elevations") > 0);
    CHECK(player.counters().tiles(*player.resources(), "branch") == 0);

    CHECK(runLines(runner, "set elevatoins.noise 1") ==
          "there is no resource 'elevatoins'; did you mean 'elevations'?");
    CHECK(runLines(runner, "set elevations.niose 1").find("has no attribute 'niose'") !=
          std::string::npos);
    CHECK(runLines(runner, "set relief.maxLevel many").find("wrong-kind") != std::string::npos);
    CHECK(player.problems().empty());
    CHECK(player.diagnostics().errors() == 0);
    CHECK(archive.picture().bytes == raised.bytes);

    CHECK(runLines(runner, "set relief.horizonCulling false") == ""); // not written so far
    archive.edit("archive.xml", "maxLevel=\"5\"", "maxLevel=\"4\"");
    CHECK(runLines(runner, "reload") == ""); // elsewhere: the value that was set stays
    CHECK(archive.picture().bytes != before.bytes);
    archive.edit("archive.xml", "0,3,2,1,4,2", "0,3,2,1,4,3");
    CHECK(runLines(runner, "reload") == "");
    CHECK(archive.picture().bytes == archive.freshPicture().bytes);
}
