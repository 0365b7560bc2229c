// SPDX-License-Identifier: BSD-3-Clause
#include "mountains.h"
#include "sanitized.h"

#include "resource/manager.h"
#include "terrain/terrain_node.h"
#include "tools/terrane/allocation_counter.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace terrane;

namespace {

constexpr int kFrames = kSanitized ? 60 : 300;

/// Ends of the legs of a flight; metres and degrees. Distances count from the ground below the
/// camera, positions are those looked at.
const std::vector<View> kFlight{
    {.x0 = -20000, .y0 = 12000, .theta = 62, .phi = 120, .d = 9000},
    {.x0 = -22000, .y0 = 11000, .theta = 68, .phi = 120, .d = 700},  // down to a ridge
    {.x0 = -24500, .y0 = 10000, .theta = 72, .phi = 100, .d = 500},  // low along it
    {.x0 = -24700, .y0 = 9900, .theta = 60, .phi = 300, .d = 400},   // a turn on the spot
    {.x0 = -24000, .y0 = 9000, .theta = 45, .phi = 330, .d = 14000}, // a climb
    {.x0 = -2000, .y0 = 2000, .theta = 50, .phi = 260, .d = 6000},   // fast over the range
    {.x0 = 0, .y0 = 1000, .theta = 66, .phi = 200, .d = 120},        // a dive to the ground
};

/// @param at 0 at the start, 1 at the end
View viewAt(const TerrainViewController& controller, double at) {
    const double legs = at * static_cast<double>(kFlight.size() - 1);
    const auto leg = std::min(static_cast<std::size_t>(legs), kFlight.size() - 2);
    return controller.fromDegrees(
        controller.between(kFlight[leg], kFlight[leg + 1], legs - static_cast<double>(leg)));
}

void fly(Mountains& mountains, double at) {
    mountains.player().controller().view = viewAt(mountains.player().controller(), at);
    mountains.followGround();
    REQUIRE(mountains.player().frame());
}

void checkSilent(Player& player) {
    for (const Diagnostic& diagnostic : player.diagnostics().all())
        FAIL_CHECK(toString(diagnostic));
}

int finestLevel(const TerrainNode& terrain) {
    int level = 0;
    terrain.forEachLeaf([&](const TerrainQuad& quad) { level = std::max(level, quad.level); });
    return level;
}

/// Some frames of the flight, as fast as the whole.
std::vector<Image> pictures(const std::string& workers, int frames) {
    Mountains mountains({.archive = {{"nthreads=\"2\"", "nthreads=\"" + workers + "\""}}});
    REQUIRE(mountains.player().load());
    std::vector<Image> result;
    for (int i = 0; i < frames; ++i) {
        fly(mountains, static_cast<double>(i) / kFrames);
        result.push_back(mountains.player().capture());
    }
    checkSilent(mountains.player());
    return result;
}

} // namespace

TEST_CASE("a flight over the mountains shows no crack") {
    Mountains mountains;
    Player& player = mountains.player();
    REQUIRE(player.load());
    const auto terrain = player.resources()->get<TerrainNode>("groundTerrain");
    int withSky = 0;
    std::set<int> levels;
    for (int i = 0; i < kFrames; ++i) {
        CAPTURE(i);
        fly(mountains, static_cast<double>(i) / (kFrames - 1));
        const Gaps gaps = mountains.gaps();
        CHECK(gaps.cracks.empty());
        CHECK(gaps.holes == 0);
        withSky += gaps.sky > 0;
        levels.insert(finestLevel(*terrain));
    }
    checkSilent(player);
    // The flight is what it is meant to be.
    CHECK(withSky > kFrames / 4);
    CHECK(withSky < kFrames * 3 / 4);
    CHECK(*levels.begin() <= 5);
    CHECK(*levels.rbegin() >= 11);
}

TEST_CASE("levels meet within rounding, skirts or not, and only because of the transition") {
    const std::pair<std::string, std::string> plainGrid{"gridskirt.mesh", "grid.mesh"};
    const int frames = kSanitized ? 6 : 30;
    const auto crackedPixels = [&](const MountainEdits& edits) {
        Mountains mountains(edits);
        REQUIRE(mountains.player().load());
        std::size_t count = 0;
        for (int i = 0; i < frames; ++i) {
            fly(mountains, i / (frames - 1.0));
            count += mountains.gaps().cracks.size();
        }
        checkSilent(mountains.player());
        return count;
    };
    CHECK(crackedPixels({.archive = {plainGrid}}) < 10); // of 77,000 a frame
    CHECK(crackedPixels({.archive = {plainGrid},
                         .ground = {{"mix(zfc.z, zfc.y, blend)", "zfc.z"}}}) > 10U * frames);
}

TEST_CASE("a flight looks the same each time, with any number of workers") {
    const int frames = kSanitized ? 6 : 30;
    const std::vector<Image> expected = pictures("2", frames);
    for (const char* workers : {"2", "1", "0"}) {
        CAPTURE(workers);
        const std::vector<Image> actual = pictures(workers, frames);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            CAPTURE(i);
            CHECK(actual[i].bytes == expected[i].bytes);
        }
    }
}

TEST_CASE("caches that are too small are told with sizes that would do, and leave no hole") {
    const std::string whole = "nTiles=\"640\"";
    Mountains mountains({.archive = {{whole, "nTiles=\"40\""}, {whole, "nTiles=\"30\""}}});
    Player& player = mountains.player();
    REQUIRE(player.load());
    for (int i = 0; i < 10; ++i) {
        CAPTURE(i);
        fly(mountains, i / 9.0);
        CHECK(mountains.gaps().holes == 0);
    }
    const std::vector<Diagnostic> reports = player.diagnostics().all();
    CHECK(reports.size() >= 2);
    CHECK(reports.size() <= 12); // not each frame
    for (const Diagnostic& report : reports) {
        CHECK(report.code == "cache-full");
        CHECK(report.severity == Severity::error);
        const bool elevation = report.message.starts_with("cache 'elevationCache' has 40 slots");
        const bool normal = report.message.starts_with("cache 'normalCache' has 30 slots");
        CHECK((elevation || normal));
    }
}

TEST_CASE("caches of the size that is told are large enough") {
    std::map<std::string, std::string> sizes{{"elevationCache", "40"}, {"normalCache", "30"}};
    for (int attempt = 0; attempt < 2; ++attempt) {
        const std::string whole = "nTiles=\"640\"";
        Mountains mountains({.archive = {{whole, "nTiles=\"" + sizes["elevationCache"] + "\""},
                                         {whole, "nTiles=\"" + sizes["normalCache"] + "\""}}});
        REQUIRE(mountains.player().load());
        for (int i = 0; i < 5; ++i)
            CHECK(mountains.player().frame());
        const std::vector<Diagnostic> reports = mountains.player().diagnostics().all();
        CHECK(reports.size() == (attempt == 0 ? 2 : 0));
        const std::regex told("cache '(\\w+)' has \\d+ slots; this view needs at least (\\d+);.*");
        for (const Diagnostic& report : reports) {
            std::smatch match;
            REQUIRE(std::regex_match(report.message, match, told));
            sizes[match[1]] = match[2];
        }
    }
}

TEST_CASE("a steady frame allocates nothing") {
    Mountains mountains({}, {.recordFrames = true, .allocations = countedAllocations});
    Player& player = mountains.player();
    REQUIRE(player.load());
    REQUIRE(player.drawUntilComplete());
    for (int i = 0; i < 3; ++i) {
        CHECK(player.frame());
        CHECK(player.counters().allocationsLastFrame == 0);
    }
}
