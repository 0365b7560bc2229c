// SPDX-License-Identifier: BSD-3-Clause
#include "planet.h"
#include "sanitized.h"

#include "resource/manager.h"
#include "terrain/terrain_node.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace terrane;

namespace {

constexpr int kFrames = kSanitized ? 15 : 30;

/// Longitude and latitude of a corner of the cube, degrees.
constexpr double kCornerLatitude = 35.2643896828;

struct Flight {
    const char* name;
    View from, to; ///< degrees
};

const Flight kFlights[] = {
    {"across the edge of a cube, from high up",
     {.x0 = 30, .y0 = 4, .theta = 50, .phi = 280, .d = 400000},
     {.x0 = 60, .y0 = -3, .theta = 60, .phi = 260, .d = 200000}},
    {"along the edge of a cube",
     {.x0 = 44.98, .y0 = -20, .theta = 75, .phi = 0, .d = 30000},
     {.x0 = 45.02, .y0 = -18, .theta = 75, .phi = 10, .d = 20000}},
    {"across a corner of the cube",
     {.x0 = 44, .y0 = 34.8, .theta = 60, .phi = 300, .d = 60000},
     {.x0 = 46, .y0 = 35.7, .theta = 70, .phi = 300, .d = 20000}},
    {"down to a corner of the cube",
     {.x0 = 45.3, .y0 = 35.3, .theta = 30, .phi = 40, .d = 3000000},
     {.x0 = 45.001, .y0 = kCornerLatitude, .theta = 70, .phi = 100, .d = 15000}},
    {"across a pole",
     {.x0 = 20, .y0 = 88, .theta = 65, .phi = 0, .d = 60000},
     {.x0 = -150, .y0 = 88, .theta = 65, .phi = 0, .d = 25000}},
    // Slowly, since the ground below the camera is known some frames late.
    {"low over the edge of a cube, on an island",
     {.x0 = -45.0001, .y0 = 22.14, .theta = 75, .phi = 250, .d = 12},
     {.x0 = -44.9999, .y0 = 22.1401, .theta = 76, .phi = 300, .d = 16}},
    {"low over a corner of the cube",
     {.x0 = 44.9999, .y0 = kCornerLatitude - 0.0001, .theta = 76, .phi = 310, .d = 16},
     {.x0 = 45.0001, .y0 = kCornerLatitude + 0.0001, .theta = 75, .phi = 330, .d = 20}},
    {"low over a pole",
     {.x0 = 10, .y0 = 89.9999, .theta = 75, .phi = 0, .d = 12},
     {.x0 = 185, .y0 = 89.9999, .theta = 75, .phi = 0, .d = 12}},
};

// Land in the corners of the cube, which may lie in the sea.
const TextEdits kLandInCorners{{"clamp(corner, -3000.0, 300.0)", "1500.0"}};

struct Found {
    std::size_t cracks = 0;
    int holes = 0;
};

Found fly(Planet& planet, const Flight& flight, int frames, bool mostlyGround = true) {
    Found found;
    const TerrainViewController& controller = planet.player().controller();
    const View from = controller.fromDegrees(flight.from), to = controller.fromDegrees(flight.to);
    planet.draw(flight.from);
    REQUIRE(planet.player().drawUntilComplete()); // the ground below the camera is known
    for (int i = 0; i < frames; ++i) {
        CAPTURE(i);
        planet.draw(controller.toDegrees(controller.between(from, to, i / (frames - 1.0))));
        const Gaps gaps = planet.gaps();
        found.cracks += gaps.cracks.size();
        found.holes += gaps.holes;
        if (mostlyGround) CHECK(gaps.sky < 320 * 240 * 2 / 3);
    }
    return found;
}

} // namespace

TEST_CASE("flights over the planet show no crack: edges and corners of the cube, poles") {
    for (const auto& relief : {TextEdits{}, kLandInCorners}) {
        const bool asItIs = relief.empty();
        CAPTURE(asItIs);
        Planet planet({.relief = relief});
        REQUIRE(planet.player().load());
        for (const Flight& flight : kFlights) {
            CAPTURE(std::string(flight.name));
            if (!asItIs && std::string(flight.name).find("corner") == std::string::npos) continue;
            const Found found = fly(planet, flight, kFrames);
            CHECK(found.cracks == 0);
            CHECK(found.holes == 0);
        }
        for (const Diagnostic& diagnostic : planet.player().diagnostics().all())
            FAIL_CHECK(toString(diagnostic));
    }
}

TEST_CASE("fast flights show no crack either, at any size, drawn by OSMesa and by EGL") {
    const Flight flights[] = {
        {"down to the ground",
         {.x0 = -20, .y0 = -30, .theta = 20, .phi = 0, .d = 900000},
         {.x0 = -4, .y0 = 15, .theta = 80, .phi = 200, .d = 3}},
        {"around half of the planet, low",
         {.x0 = -170, .y0 = -50, .theta = 78, .phi = 270, .d = 900},
         {.x0 = 0, .y0 = 60, .theta = 78, .phi = 270, .d = 40}},
        {"straight down, then up",
         {.x0 = 12, .y0 = 41, .theta = 0, .phi = 0, .d = 20},
         {.x0 = 13, .y0 = 43, .theta = 65, .phi = 90, .d = 800000}},
    };
    struct Picture {
        int width, height;
        HeadlessKind kind;
    };
    for (const Picture& picture :
         {Picture{320, 240, HeadlessKind::osmesa}, Picture{333, 211, HeadlessKind::egl},
          Picture{640, 480, HeadlessKind::egl}}) {
        CAPTURE(picture.width);
        PlayerOptions options = Planet::small();
        options.width = picture.width;
        options.height = picture.height;
        options.headless = picture.kind;
        Planet planet({}, options);
        REQUIRE(planet.player().load());
        for (const Flight& flight : flights) {
            CAPTURE(std::string(flight.name));
            const Found found = fly(planet, flight, kFrames, false);
            CHECK(found.cracks == 0);
            CHECK(found.holes == 0);
        }
    }
}

TEST_CASE("a crack between the faces of a planet would be found") {
    PlanetEdits edits{.relief = kLandInCorners};
    for (int face = 1; face <= 6; ++face)
        edits.archive.emplace_back("gridskirt.mesh", "grid.mesh");
    // The heights of a face, lifted.
    edits.archive.emplace_back("<rotatex angle=\"90\"/><rotatey angle=\"180\"/>",
                               "<rotatex angle=\"90\"/><rotatey angle=\"180\"/>"
                               "<translate x=\"0\" y=\"0\" z=\"3000\"/>");
    Planet planet(edits);
    REQUIRE(planet.player().load());
    CHECK(fly(planet, kFlights[1], 6).cracks > 20);
}
