// SPDX-License-Identifier: BSD-3-Clause
#include "crack_finder.h"

#include <doctest/doctest.h>

#include <string>

using namespace terrane;

namespace {

constexpr Colour kBackground{255, 0, 255};

/// From rows of characters, the upper one first: '.' is background, all else terrain.
Image drawn(const std::vector<std::string>& rows) {
    const auto height = static_cast<int>(rows.size());
    Image image = makeImage(static_cast<int>(rows[0].size()), height, 3);
    for (int y = 0; y < height; ++y) {
        const std::string& row = rows[static_cast<std::size_t>(height - 1 - y)];
        for (int x = 0; x < image.width; ++x) {
            if (row[static_cast<std::size_t>(x)] != '.') continue;
            unsigned char* pixel = image.row(y) + 3 * x;
            for (int c = 0; c < 3; ++c)
                pixel[c] = kBackground[static_cast<std::size_t>(c)];
        }
    }
    return image;
}

} // namespace

TEST_CASE("cracks are told from sky and from holes") {
    struct Row {
        const char* name;
        std::vector<std::string> picture;
        std::size_t cracks;
        int holes, sky;
    };
    const Row rows[] = {
        {"no terrain", {"....", "...."}, 0, 0, 8},
        {"no background", {"####", "####"}, 0, 0, 0},
        {"one pixel", {"#####", "##.##", "#####"}, 1, 1, 0},
        {"a line", {"#####", ".....", "#####"}, 5, 5, 0},
        {"a slanting line", {"#####", "#.###", "##.##", "###.#", "#####"}, 3, 3, 0},
        {"a line of two pixels", {"#####", ".....", ".....", "#####"}, 10, 10, 0},
        {"a hole, whose sides are no cracks",
         {"#######", "#.....#", "#.....#", "#.....#", "#.....#", "#.....#", "#######"},
         16,
         25,
         0},
        {"a crack at the lower edge", {"#####", "##.##"}, 1, 1, 0},
        {"sky between two peaks", {".....", "#...#", "##.##", "#####"}, 0, 0, 9},
        {"sky beside a leaning rock", {"......", "##..##", "#..###", "######"}, 0, 0, 10},
        {"a crack below a ridge", {".....", "#####", "##.##", "#####"}, 1, 1, 5},
        {"a crack that turns under terrain", {"#.###", "#.###", "#...#", "#####"}, 1, 1, 4},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const Gaps gaps = findGaps(drawn(row.picture), kBackground);
        CHECK(gaps.cracks.size() == row.cracks);
        CHECK(gaps.holes == row.holes);
        CHECK(gaps.sky == row.sky);
    }
}

TEST_CASE("a crack has its place, counted from the lower left") {
    const Gaps gaps = findGaps(drawn({"#####", "#####", "###.#", "#####"}), kBackground);
    REQUIRE(gaps.cracks.size() == 1);
    CHECK(gaps.cracks[0].x == 3);
    CHECK(gaps.cracks[0].y == 1);
}
