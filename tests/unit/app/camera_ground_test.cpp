// SPDX-License-Identifier: BSD-3-Clause
#include "hills.h"

#include "app/player.h"
#include "core/image.h"
#include "scene/scene_manager.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

// Where the ground keeps the camera.
using namespace terrane;

namespace {

/// Draws a frame; how high its camera is above the ground as the finest tiles then show it, and
/// that ground.
std::pair<double, double> heightAboveGround(Player& player) {
    REQUIRE(player.frame());
    const glm::dvec3 camera(player.scene()->cameraToWorld()[3]);
    const auto place = player.placeAt(camera.x, camera.y);
    REQUIRE(place);
    const auto ground = player.elevationAt(*place);
    REQUIRE(ground);
    return {camera.z - ground->elevation, ground->elevation};
}

} // namespace

TEST_CASE("the first picture, and that after a jump, is taken from where the camera will stay") {
    for (const auto shape : {Hills::Shape::flat, Hills::Shape::planet}) {
        CAPTURE(static_cast<int>(shape));
        Hills hills(shape);
        Player& player = hills.player();
        REQUIRE(player.load());
        for (int i = 0; i < 12; ++i) {
            CAPTURE(i);
            View view{.x0 = 700 * std::cos(2.0 * i),
                      .y0 = 700 * std::sin(3.0 * i + 1),
                      .theta = 80,
                      .phi = 50.0 * i,
                      .d = 20};
            if (shape == Hills::Shape::planet) view.x0 = 110.0 * i, view.y0 = -75 + 13.0 * i;
            hills.look(view);
            REQUIRE(player.frame());
            const glm::dvec3 at(player.scene()->cameraToWorld()[3]);
            REQUIRE(player.drawUntilComplete());
            const glm::dvec3 stays(player.scene()->cameraToWorld()[3]);
            CHECK(glm::distance(at, stays) < 0.6);
        }
    }
}

TEST_CASE("a flat terrain that its node has lifted carries the camera with it") {
    const View view{.x0 = -300, .y0 = -200, .theta = 83, .phi = 23, .d = 60};
    std::vector<glm::dvec3> cameras;
    std::vector<Image> pictures;
    for (const char* const edit : {"", "<translate x='0' y='0' z='730'/>"}) {
        Hills hills(Hills::Shape::flat,
                    {{"<node name='ground1' flags='ground'>",
                      std::string("<node name='ground1' flags='ground'>") + edit}});
        REQUIRE(hills.player().load());
        hills.look(view);
        REQUIRE(hills.player().drawUntilComplete());
        cameras.emplace_back(hills.player().scene()->cameraToWorld()[3]);
        pictures.push_back(hills.player().capture());
    }
    CHECK(glm::distance(cameras[0] + glm::dvec3(0, 0, 730), cameras[1]) < 1e-6);
    CHECK(comparePictures(pictures[0], pictures[1]).share <= 0.002); // floats in the shader
}

TEST_CASE("a camera that is somewhere else in each frame is never in a hill") {
    Hills hills;
    Player& player = hills.player();
    REQUIRE(player.load());
    for (int i = 0; i < kFlightFrames; ++i) {
        CAPTURE(i);
        hills.look({.x0 = 850 * std::cos(1.9 * i),
                    .y0 = 850 * std::sin(2.6 * i),
                    .theta = 86,
                    .phi = 77.0 * i,
                    .d = 12});
        CHECK(heightAboveGround(player).first > 0.3);
    }
}

TEST_CASE("a flight that would end in a hill stays above it") {
    Hills hills;
    Player& player = hills.player();
    REQUIRE(player.load());
    hills.look({.x0 = -900, .y0 = 100, .theta = 88, .phi = 270, .d = 10});
    REQUIRE(player.drawUntilComplete());
    double least = 1e9, most = -1e9;
    // 3 m a frame, since what is read back is some frames late.
    for (int i = 0; i < 600; ++i) {
        CAPTURE(i);
        hills.look({.x0 = -900 + 3.0 * i, .y0 = 100, .theta = 88, .phi = 270, .d = 10});
        const auto [above, ground] = heightAboveGround(player);
        CHECK(above > 0.3);
        least = std::min(least, ground);
        most = std::max(most, ground);
    }
    CHECK(most - least > 100); // there were hills in the way
}

TEST_CASE("a camera that turns, stops and jumps stays above the ground, too") {
    Hills hills;
    Player& player = hills.player();
    REQUIRE(player.load());
    hills.look(Hills::kViews[0]);
    REQUIRE(player.drawUntilComplete());
    for (int i = 0; i < 2 * kFlightFrames; ++i) {
        CAPTURE(i);
        // Circles, with a halt now and then and a jump each 25 frames.
        const double t = (i % 25 < 18 ? i : i - i % 25 + 18) * 0.13 + 40 * (i / 25);
        const double radius = 300 + 250 * std::sin(i / 25 * 1.7);
        hills.look({.x0 = radius * std::cos(t),
                    .y0 = radius * std::sin(t),
                    .theta = 70,
                    .phi = 50 * t,
                    .d = 12});
        CHECK(heightAboveGround(player).first > 0);
    }
}
