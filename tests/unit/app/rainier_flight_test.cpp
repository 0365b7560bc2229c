// SPDX-License-Identifier: BSD-3-Clause
// A flight around Mount Rainier, as tests/fixtures/residualProducer/rainier shows it.
#include "archive_folder.h"
#include "crack_finder.h"

#include "app/player.h"

#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <string>
#include <vector>

using namespace terrane;
namespace fs = std::filesystem;

namespace {

constexpr Colour kBackground{255, 0, 255};

/// Ends of the legs; metres and degrees. From within the terrain, so that there is ground up to the
/// horizon.
const std::vector<View> kFlight{
    {.x0 = -9000, .y0 = 10000, .theta = 55, .phi = 40, .d = 12000},
    {.x0 = -10274, .y0 = 4624, .theta = 84, .phi = 22, .d = 1000},  // down to a ridge
    {.x0 = -12800, .y0 = 13800, .theta = 75, .phi = 50, .d = 600},  // up the glaciers
    {.x0 = -14770, .y0 = 15730, .theta = 80, .phi = 200, .d = 500}, // around the summit
    {.x0 = -12000, .y0 = 9000, .theta = 40, .phi = 220, .d = 9000},
};

std::string edited(std::string text, const std::string& before, const std::string& after) {
    const std::size_t at = text.find(before);
    REQUIRE(at != std::string::npos);
    return text.replace(at, before.size(), after);
}

} // namespace

TEST_CASE("a flight around a real mountain shows no crack, hole or error") {
    const char* const data = std::getenv("TERRANE_TEST_DATA");
    const char* const source = std::getenv("TERRANE_SOURCE");
    if (!source || !data || !fs::exists(fs::path(data) / "rainier/DEM.dat")) {
        MESSAGE("skipped: no rainier/DEM.dat in TERRANE_TEST_DATA");
        return;
    }
    const fs::path fixture = fs::path(source) / "tests/fixtures/residualProducer/rainier";
    const auto archive = readFile(fixture / "archive.xml");
    REQUIRE(archive);
    ArchiveFolder folder;
    folder.write("archive.xml",
                 edited(*archive, "r=\"0.62\" g=\"0.74\" b=\"0.87\"", "r=\"1\" g=\"0\" b=\"1\""));
    PlayerOptions options;
    options.archive = folder.path();
    options.paths = {fixture, fs::path(data)};
    options.width = 320;
    options.height = 240;
    options.debug = true;
    Player player(standardRegistry(), options);
    REQUIRE(player.load());

    constexpr int kFrames = 40;
    int withSky = 0;
    for (int i = 0; i < kFrames; ++i) {
        CAPTURE(i);
        const double legs = i * (kFlight.size() - 1.0) / (kFrames - 1);
        const auto leg = std::min(static_cast<std::size_t>(legs), kFlight.size() - 2);
        auto& controller = player.controller();
        controller.view = controller.fromDegrees(
            controller.between(kFlight[leg], kFlight[leg + 1], legs - static_cast<double>(leg)));
        // At 300 m a step the camera would be in the ground before that is read back.
        for (int frame = 0; frame < 8; ++frame)
            REQUIRE(player.frame());
        const Gaps gaps = findGaps(player.capture(), kBackground);
        CHECK(gaps.cracks.empty());
        CHECK(gaps.holes == 0);
        withSky += gaps.sky > 0;
    }
    CHECK(withSky > kFrames / 4);
    for (const Diagnostic& diagnostic : player.diagnostics().all())
        FAIL_CHECK(toString(diagnostic));
}
