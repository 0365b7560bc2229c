// SPDX-License-Identifier: BSD-3-Clause
#include "plugin_terrain/elevation_oracle.h"
#include "plugin_terrain/terrain_fixture.h"

#include <algorithm>
#include <cmath>

using namespace terrane;
using terrane::test::ElevationOracle;
using terrane::test::TerrainFixture;

namespace {

constexpr double kRootQuadSize = 100000;

struct Case {
    const char* name;
    int tileSize;
    int gridSize;
    int face;
    bool flip;
    bool clamp;
    const char* noise;
    std::vector<double> amplitudes;
};

const std::vector<double> kAmplitudes{2500, -1200, 700, 340, -180, 80, 40, 19, 9, 4.5};
const char* const kNoise = "2500,-1200,700,340,-180,80,40,19,9,4.5";

const Case kCases[] = {
    {"the size of the examples", 101, 24, 0, false, true, kNoise, kAmplitudes},
    {"one texel for each vertex", 29, 24, 1, false, true, kNoise, kAmplitudes},
    {"eight texels for each vertex", 197, 24, 3, false, false, kNoise, kAmplitudes},
    {"a coarse mesh", 69, 8, 6, false, true, kNoise, kAmplitudes},
    {"diagonals that flip", 101, 24, 2, true, false, kNoise, kAmplitudes},
    {"diagonals that flip, one texel for each vertex", 53, 48, 5, true, true, kNoise, kAmplitudes},
    {"noise at the first levels only", 53, 24, 4, false, true, "5000,1000", {5000, 1000}},
};

std::string archive(const Case& c, const std::string& storage = "RGB32F") {
    return "<module name=\"upsampleShader\" version=\"330\" source=\"upsample.glsl\"" +
           std::string(c.clamp ? "" : " options=\"NO_CLAMP\"") +
           "/>\n"
           "<tileCache name=\"cache\" scheduler=\"scheduler\"><gpuTileStorage tileSize=\"" +
           std::to_string(c.tileSize) + "\" nTiles=\"60\" internalformat=\"" + storage +
           "\" format=\"RGB\" type=\"FLOAT\" min=\"LINEAR\" mag=\"LINEAR\"/></tileCache>\n"
           "<elevationProducer name=\"elevations\" cache=\"cache\" noise=\"" +
           c.noise + "\" gridSize=\"" + std::to_string(c.gridSize) + "\" face=\"" +
           std::to_string(c.face) + "\"" + (c.flip ? " flip=\"true\"" : "") + "/>\n";
}

// The larger of a millimetre and four steps of a float.
double tolerance(double value) {
    const double step = std::ldexp(1.0, std::ilogb(std::max(std::abs(value), 1e-30)) - 23);
    return std::max(1e-3, 4 * step);
}

struct Worst {
    double excess = 0; ///< error over tolerance
    std::string where;
    void add(double value, double expected, double scale, const std::string& place) {
        const double e = std::abs(value - expected) / tolerance(scale);
        if (e <= excess) return;
        excess = e;
        where = place + ": " + std::to_string(value) + ", not " + std::to_string(expected);
    }
};

void compare(const std::vector<glm::vec4>& texels, const ElevationOracle::Tile& expected,
             Worst& worst) {
    const int w = expected.width();
    REQUIRE(texels.size() == static_cast<std::size_t>(w) * w);
    for (int k = 0; k < w; ++k) {
        for (int i = 0; i < w; ++i) {
            const glm::vec4& texel = texels[static_cast<std::size_t>(k) * w + i];
            const ElevationOracle::Texel& right = expected.at(i, k);
            const std::string place = std::to_string(i) + "," + std::to_string(k);
            // Elevations are sums of terms as large as the largest amplitude.
            const double scale = std::max(std::abs(right.zf), 2500.0);
            worst.add(texel.x, right.zf, scale, "zf at " + place);
            worst.add(texel.y, right.zc, scale, "zc at " + place);
            worst.add(texel.z, right.zm, scale, "zm at " + place);
        }
    }
}

// A path down to level 7 that goes by all four children, then tiles all over the levels.
std::vector<TileId> someTiles() {
    std::vector<TileId> tiles{{0, 0, 0}, {1, 0, 0},   {1, 1, 0},   {1, 0, 1},   {1, 1, 1},
                              {2, 3, 0}, {2, 0, 3},   {2, 1, 2},   {3, 5, 2},   {3, 0, 7},
                              {4, 9, 6}, {5, 18, 13}, {5, 31, 31}, {6, 37, 26}, {7, 74, 53}};
    return tiles;
}

} // namespace

TEST_CASE("Elevation tiles are what the oracle computes in double precision, borders included") {
    for (const Case& c : kCases) {
        CAPTURE(c.name);
        TerrainFixture f;
        f.open(archive(c));
        TileProducer* const producer = f.producer("elevations");
        REQUIRE(producer);
        producer->setRootQuadSize(kRootQuadSize);
        ElevationOracle oracle({.tileSize = c.tileSize,
                                .gridSize = c.gridSize,
                                .face = c.face,
                                .flip = c.flip,
                                .clamp = c.clamp,
                                .amplitudes = c.amplitudes});
        for (const TileId& id : someTiles()) {
            CAPTURE(id.level);
            CAPTURE(id.tx);
            CAPTURE(id.ty);
            Worst worst;
            compare(f.texels(f.make(*producer, id)), oracle.tile(id.level, id.tx, id.ty), worst);
            CAPTURE(worst.where);
            CHECK(worst.excess <= 1);
        }
    }
}

TEST_CASE("Neighbouring elevation tiles agree bit by bit where they overlap") {
    TerrainFixture f;
    const Case& c = kCases[0];
    f.open(archive(c));
    TileProducer* const producer = f.producer("elevations");
    REQUIRE(producer);
    producer->setRootQuadSize(kRootQuadSize);
    const int w = c.tileSize, n = w - 5;
    // The largest difference of zf and zm over the columns (or rows) that both tiles have.
    const auto difference = [&](const TileId& a, const TileId& b, bool vertical) {
        const auto left = f.texels(f.make(*producer, a)), right = f.texels(f.make(*producer, b));
        float largest = 0;
        for (int k = 2; k <= n + 2; ++k) {
            for (int i = 0; i < 5; ++i) {
                const std::size_t l = vertical ? (n + i) * w + k : k * w + n + i;
                const std::size_t r = vertical ? i * w + k : k * w + i;
                largest = std::max(largest, std::abs(left[l].x - right[r].x));
                largest = std::max(largest, std::abs(left[l].z - right[r].z));
            }
        }
        return largest;
    };
    CHECK(difference({1, 0, 0}, {1, 1, 0}, false) == 0);
    CHECK(difference({2, 1, 2}, {2, 2, 2}, false) == 0);
    CHECK(difference({4, 7, 9}, {4, 8, 9}, false) == 0);
    CHECK(difference({1, 0, 0}, {1, 0, 1}, true) == 0);
    CHECK(difference({4, 7, 7}, {4, 7, 8}, true) == 0);
    CHECK(difference({6, 20, 31}, {6, 20, 32}, true) == 0);
}

TEST_CASE("The face of a producer is the last character of its name, unless it is said") {
    TerrainFixture f;
    const std::string storage = "<gpuTileStorage tileSize=\"29\" nTiles=\"10\" "
                                "internalformat=\"RGBA32F\" format=\"RGBA\" type=\"FLOAT\"/>";
    f.open("<tileCache name=\"cache\" scheduler=\"scheduler\">" + storage + "</tileCache>\n" +
           "<elevationProducer name=\"ground3\" cache=\"cache\" noise=\"100\"/>\n"
           "<elevationProducer name=\"ground\" cache=\"cache\" noise=\"100\" face=\"3\"/>\n"
           "<elevationProducer name=\"ground4\" cache=\"cache\" noise=\"100\" face=\"3\"/>\n"
           "<elevationProducer name=\"other\" cache=\"cache\" noise=\"100\"/>\n");
    std::vector<std::vector<glm::vec4>> tiles;
    for (const char* name : {"ground3", "ground", "ground4", "other"}) {
        TileProducer* const producer = f.producer(name);
        REQUIRE(producer);
        tiles.push_back(f.texels(f.make(*producer, {0, 0, 0})));
    }
    CHECK(tiles[0] == tiles[1]);
    CHECK(tiles[0] == tiles[2]);
    CHECK(tiles[0] != tiles[3]);
}

TEST_CASE("An edit of the noise's amplitude changes tiles when they are made again") {
    TerrainFixture f;
    f.open(archive(kCases[1]));
    TileProducer* const producer = f.producer("elevations");
    REQUIRE(producer);
    Tile& tile = f.make(*producer, {3, 4, 4});
    const auto before = f.texels(tile);
    CHECK(producer->statistics().tiles == 4);
    CHECK(producer->invalidateTiles() == 4);
    CHECK_FALSE(tile.done());
    CHECK(f.texels(f.make(*producer, {3, 4, 4})) == before);
    CHECK(producer->statistics().tiles == 8);
}
