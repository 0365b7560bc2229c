// SPDX-License-Identifier: BSD-3-Clause
// Elevations of real files, tile by tile, against a reconstruction in double precision.
#include "plugin_terrain/residual_fixture.h"
#include "plugin_terrain/residual_oracle.h"

#include <algorithm>

using namespace terrane;
using namespace terrane::test;

namespace {

struct Case {
    const char* file;
    int delta;
    int tileSize; ///< of elevations
};

const Case kCases[] = {{"rainier/DEM.dat", 0, 29},
                       {"rainier/DEM.dat", 1, 53},
                       {"rainier/DEM.dat", 2, 101},
                       {"rainier/DEM.dat", 3, 197},
                       {"proland/DEM.dat", 2, 101}};

std::string archive(const Case& c) {
    return cpuCache("residualCache", 197) + floatCache("gpuCache", c.tileSize) +
           cpuCache("cpuCache", c.tileSize) +
           "<residualProducer name=\"residuals\" cache=\"residualCache\" file=\"" + c.file +
           "\" delta=\"" + std::to_string(c.delta) +
           "\"/>\n"
           "<elevationProducer name=\"gpu\" cache=\"gpuCache\" residuals=\"residuals\" "
           "flip=\"true\" upsampleProg=\"raw;\"/>\n"
           "<cpuElevationProducer name=\"cpu\" cache=\"cpuCache\" residuals=\"residuals\"/>\n"
           "<module name=\"raw\" version=\"330\" source=\"upsample.glsl\" options=\"NO_CLAMP\"/>\n";
}

// Error over tolerance, the worst of all.
struct Worst {
    double gpu = 0, cpu = 0, shown = 0;
};

// Tiles are given back when their quad and those below it are done, so few of them are held.
void compareBelow(TerrainFixture& f, ResidualOracle& oracle, const Case& c, const TileId& id,
                  Worst& worst, int& tiles) {
    TileProducer& gpu = *f.producer("gpu");
    TileProducer& cpu = *f.producer("cpu");
    Tile& onGpu = f.make(gpu, id);
    Tile& onCpu = f.make(cpu, id);
    const auto texels = f.texels(onGpu);
    const auto heights = values(onCpu);
    const auto expected = oracle.quad(c.delta, id.level, id.tx, id.ty);
    REQUIRE(texels.size() == expected.size());
    REQUIRE(heights.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double tolerance = elevationTolerance(expected[i]);
        worst.gpu = std::max(worst.gpu, std::abs(texels[i].x - expected[i]) / tolerance);
        worst.cpu = std::max(worst.cpu, std::abs(heights[i] - expected[i]) / tolerance);
        worst.shown = std::max<double>(worst.shown, std::abs(texels[i].z - texels[i].x));
    }
    ++tiles;
    if (f.producer("residuals")->hasTile({id.level + 1, 0, 0}))
        for (int i = 0; i < 4; ++i)
            compareBelow(f, oracle, c, id.child(i % 2, i / 2), worst, tiles);
    gpu.putTile(onGpu);
    cpu.putTile(onCpu);
}

} // namespace

TEST_CASE("All elevation tiles of the shipped files are those of a double-precision computation") {
    for (const Case& c : kCases) {
        CAPTURE(std::string(c.file));
        CAPTURE(c.delta);
        const std::string bytes = testData(c.file);
        if (bytes.empty()) continue;
        TerrainFixture f;
        f.write(c.file, bytes);
        f.open(archive(c));
        for (const char* name : {"gpu", "cpu"}) {
            REQUIRE(f.producer(name));
            f.producer(name)->setRootQuadSize(2 * 30740);
        }
        CHECK(f.producer("residuals")->rootQuadSize() == 61480);
        ResidualOracle oracle(bytes);
        Worst worst;
        int tiles = 0;
        compareBelow(f, oracle, c, {0, 0, 0}, worst, tiles);
        const int levels = oracle.maxLevel() - c.delta + 1;
        CHECK(tiles == ((1 << 2 * levels) - 1) / 3);
        CAPTURE(worst.gpu);
        CHECK(worst.gpu <= 1);
        CHECK(worst.cpu <= 1);
        CHECK(worst.shown == 0);
    }
}

TEST_CASE("The summit of Mount Rainier stands where it stands, and as high") {
    const std::string bytes = testData("rainier/DEM.dat");
    if (bytes.empty()) return;
    const Case c{"rainier/DEM.dat", 2, 101};
    TerrainFixture f;
    f.write(c.file, bytes);
    f.open(archive(c));
    // Terrain size 30740, quad level 4: 16 quads of 96 texels.
    const double texel = 61480.0 / (16 * 96);
    const double x = (-14770 + 30740) / texel, y = (15730 + 30740) / texel;
    const TileId id{4, static_cast<int>(x / 96), static_cast<int>(y / 96)};
    // Between the four texels around it; texel (2,2) is the quad's corner.
    const double u = x - id.tx * 96 + 2, v = y - id.ty * 96 + 2;
    const auto interpolated = [&](const auto& at) {
        const int i = static_cast<int>(u), k = static_cast<int>(v);
        const double a = u - i, b = v - k;
        return (1 - b) * ((1 - a) * at(i, k) + a * at(i + 1, k)) +
               b * ((1 - a) * at(i, k + 1) + a * at(i + 1, k + 1));
    };
    const auto texels = f.texels(f.make(*f.producer("gpu"), id));
    const auto heights = values(f.make(*f.producer("cpu"), id));
    const double gpu = interpolated([&](int i, int k) { return double{texels[k * 101 + i].z}; });
    const double cpu = interpolated([&](int i, int k) { return double{heights[k * 101 + i]}; });
    CHECK(std::abs(gpu - 4368.6) <= 0.5);
    CHECK(std::abs(cpu - 4368.6) <= 0.5);
    CHECK(*std::max_element(heights.begin(), heights.end()) < 4400);
}

TEST_CASE(
    "Elevations of a file with another tile size than its delta asks for name the right one") {
    const std::string bytes = testData("rainier/DEM.dat");
    if (bytes.empty()) return;
    for (const Case& c : {kCases[0], kCases[1], kCases[2], kCases[3]}) {
        for (const int tileSize : {29, 53, 101, 197, 100}) {
            CAPTURE(c.delta);
            CAPTURE(tileSize);
            TerrainFixture f;
            f.write(c.file, bytes);
            f.open(archive({c.file, c.delta, tileSize}) +
                   "<tileCache name=\"n\" scheduler=\"scheduler\"><gpuTileStorage tileSize=\"" +
                   std::to_string(c.tileSize - 4) +
                   "\" nTiles=\"4\" internalformat=\"RG8\" format=\"RG\" "
                   "type=\"UNSIGNED_BYTE\"/></tileCache>\n"
                   "<normalProducer name=\"normals\" cache=\"n\" elevations=\"gpu\"/>\n");
            const bool good = f.producer("normals") != nullptr;
            CHECK((f.producer("cpu") != nullptr) == good);
            CHECK(good == (tileSize == c.tileSize));
            for (const Diagnostic& d : f.diagnostics.all()) {
                if (d.code != "wrong-tile-size") continue;
                CHECK(d.expected ==
                      std::to_string(c.tileSize) + "; for delta 0, 1, 2, 3: 29, 53, 101, 197");
                CHECK(d.place.file->text()
                          .substr(d.place.offset)
                          .starts_with(std::to_string(tileSize) + "\""));
            }
            const std::string told = f.told();
            CHECK(told.empty() == good);
        }
    }
}

TEST_CASE("Neighbouring tiles of real elevations agree bit by bit where they overlap") {
    const std::string bytes = testData("rainier/DEM.dat");
    if (bytes.empty()) return;
    const Case c = kCases[2];
    TerrainFixture f;
    f.write(c.file, bytes);
    f.open(archive(c));
    const auto difference = [&](const TileId& a, const TileId& b, bool above) {
        const auto first = f.texels(f.make(*f.producer("gpu"), a));
        const auto second = f.texels(f.make(*f.producer("gpu"), b));
        float largest = 0;
        for (int k = 2; k <= 98; ++k)
            for (int i = 0; i < 5; ++i) {
                const int p = above ? (96 + i) * 101 + k : k * 101 + 96 + i;
                const int q = above ? i * 101 + k : k * 101 + i;
                largest = std::max(largest, std::abs(first[p].x - second[q].x));
            }
        return largest;
    };
    // Within a residual tile, and from one to the next.
    CHECK(difference({4, 4, 12}, {4, 5, 12}, false) == 0);
    CHECK(difference({4, 3, 12}, {4, 4, 12}, false) == 0);
    CHECK(difference({4, 4, 12}, {4, 4, 13}, true) == 0);
    CHECK(difference({4, 4, 11}, {4, 4, 12}, true) == 0);
    CHECK(difference({1, 0, 1}, {1, 1, 1}, false) == 0);
    // Below the last level of the file.
    CHECK(difference({6, 17, 50}, {6, 18, 50}, false) == 0);
}
