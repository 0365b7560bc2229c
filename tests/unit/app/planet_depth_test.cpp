// SPDX-License-Identifier: BSD-3-Clause
#include "planet.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdlib>
#include <string>

using namespace terrane;

namespace {

struct Row {
    const char* name;
    View view; ///< degrees; over a coast with many islands
};

const Row kRows[] = {
    {"2 m", {.x0 = -45, .y0 = 22, .theta = 80, .d = 11.5}},
    {"2 m, in the mountains", {.x0 = 5, .y0 = 6, .theta = 80, .phi = 60, .d = 11.5}},
    {"100 m", {.x0 = -45, .y0 = 22, .theta = 80, .d = 580}},
    {"3 km", {.x0 = -45, .y0 = 20, .theta = 80, .d = 17000}},
    {"100 km", {.x0 = -45, .y0 = 22, .theta = 70, .phi = 90, .d = 300000}},
    {"1,000 km", {.x0 = -45, .y0 = 22, .theta = 40, .phi = 90, .d = 1300000}},
    {"10,000 km", {.x0 = -45, .y0 = 22, .d = 10000000}},
};

/// Water in one colour, land in two by its steepness: what is wrong with depths is seen best.
const std::pair<std::string, std::string> kPainted{
    "colour = vec4(developed(light * airLeft + airLight), 1.0);",
    "colour = vec4(height < 0.0 ? vec3(0, 0, 1) : vec3(1, dot(up, normal), 0), 1.0);"};

Image completePicture(Planet& planet, const View& degrees) {
    planet.draw(degrees);
    REQUIRE(planet.player().drawUntilComplete());
    return planet.player().capture();
}

/// Pixels that changed from water to land, to sky or back, or whose land has another slope.
std::size_t differences(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const unsigned char* p = a.row(y) + 3 * x;
            const unsigned char* q = b.row(y) + 3 * x;
            count += std::abs(p[0] - q[0]) + std::abs(p[1] - q[1]) + std::abs(p[2] - q[2]) > 8;
        }
    }
    return count;
}

} // namespace

TEST_CASE("sea and coast do not fight for pixels, from 2 m to 10,000 km") {
    Planet planet({.ground = {kPainted}});
    // The judge keeps, for each pixel, a depth that tells apart what differs by a millionth.
    Planet exact({.ground = {{kPainted.first,
                              kPainted.second +
                                  " gl_FragDepth = log2(1.0 + 10.0 / gl_FragCoord.w) / 40.0;"}}});
    REQUIRE(planet.player().load());
    REQUIRE(exact.player().load());
    constexpr std::size_t kPixels = 320 * 240;
    for (const Row& row : kRows) {
        CAPTURE(std::string(row.name));
        const Image picture = completePicture(planet, row.view);
        CHECK(differences(picture, completePicture(exact, row.view)) <= kPixels / 5000);
        // From a little farther away, by far less than a pixel.
        View moved = row.view;
        moved.d *= 1.00001;
        CHECK(differences(picture, completePicture(planet, moved)) <= kPixels / 200);
    }
}
