// SPDX-License-Identifier: BSD-3-Clause
#include "app/script_runner.h"

#include "app/player.h"
#include "archive_folder.h"

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
