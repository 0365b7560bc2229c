// SPDX-License-Identifier: BSD-3-Clause
#include "plugin_terrain/residual_fixture.h"
#include "plugin_terrain/tiff_writer.h"

#include <algorithm>
#include <filesystem>

using namespace terrane;
using namespace terrane::test;

namespace {

std::string residuals(const std::string& attributes, const std::string& nested = "") {
    return "<residualProducer name=\"r\" cache=\"c\" " + attributes +
           (nested.empty() ? "/>\n" : ">\n" + nested + "</residualProducer>\n");
}

// The value of a tile of floats at a texel.
float at(const std::vector<float>& tile, int stride, int x, int y) {
    return tile[static_cast<std::size_t>(y * stride + x)];
}

// All values of a tile of smallPyramid, wherever they stand in an array of this stride.
bool holds(const std::vector<float>& tile, int stride, int level, int tx, int ty, double scale) {
    const auto units = smallPyramidValues(level, tx, ty);
    const int width = level == 0 ? 9 : 13;
    for (int y = 0; y < width; ++y)
        for (int x = 0; x < width; ++x)
            if (at(tile, stride, x, y) != static_cast<float>(units[y * width + x] * scale))
                return false;
    return true;
}

bool isZero(const std::vector<float>& tile) {
    return std::all_of(tile.begin(), tile.end(), [](float value) { return value == 0; });
}

// The root of a pyramid and a part that refines its upper right tile twice.
TestPyramid part(int tileSize = 8) {
    TestPyramid pyramid{
        .maxLevel = 1, .tileSize = tileSize, .rootLevel = 3, .rootTx = 2, .rootTy = 3, .scale = 2};
    const int width = tileSize + 5;
    for (int i = 0; i < 5; ++i)
        pyramid.tiles.push_back(
            makeTiff(width, width,
                     std::vector<std::int16_t>(static_cast<std::size_t>(width) * width,
                                               static_cast<std::int16_t>(100 + i))));
    return pyramid;
}

struct ResidualFixture : TerrainFixture {
    void open(const std::string& entries, const std::string& bytes = smallPyramid().bytes()) {
        write("DEM.dat", bytes);
        TerrainFixture::open(entries);
    }
    std::vector<float> tile(int level, int tx, int ty) {
        return values(make(*producer("r"), {level, tx, ty}));
    }
    std::string messages() {
        std::string text;
        for (const Diagnostic& d : diagnostics.all())
            text += d.code + ": " + d.message + "\n";
        diagnostics.clear();
        return text;
    }
};

} // namespace

TEST_CASE_FIXTURE(ResidualFixture, "Tiles of the first levels stand in the lower left of theirs") {
    open(cpuCache("c", 13) + residuals("file=\"DEM.dat\""));
    TileProducer* const r = producer("r");
    REQUIRE(r);
    CHECK(r->border() == 2);
    CHECK(holds(tile(0, 0, 0), 13, 0, 0, 0, 1));
    CHECK(holds(tile(1, 0, 0), 13, 1, 0, 0, 1));
    for (int i = 0; i < 4; ++i)
        CHECK(holds(tile(2, i % 2, i / 2), 13, 2, i % 2, i / 2, 1));
    CHECK(r->hasTile({2, 1, 1}));
    CHECK_FALSE(r->hasTile({1, 1, 0})); // its one tile covers all four quads
    CHECK_FALSE(r->hasTile({3, 0, 0}));
    CHECK(r->hasChildren({1, 0, 0}));
    CHECK_FALSE(r->hasChildren({2, 0, 0}));
}

TEST_CASE_FIXTURE(ResidualFixture, "The scales of the file and of the archive are multiplied") {
    TestPyramid pyramid = smallPyramid();
    pyramid.scale = 0.1f;
    open(cpuCache("c", 13) + residuals("file=\"DEM.dat\" scale=\"0.5\""), pyramid.bytes());
    REQUIRE(producer("r"));
    CHECK(holds(tile(2, 1, 0), 13, 2, 1, 0, static_cast<double>(0.1f) * 0.5));
}

TEST_CASE_FIXTURE(ResidualFixture, "With a delta the root is what the levels above add up to") {
    open(cpuCache("c", 13) + residuals("file=\"DEM.dat\" delta=\"1\""));
    TileProducer* const r = producer("r");
    REQUIRE(r);
    const auto root = tile(0, 0, 0);
    const auto coarse = smallPyramidValues(0, 0, 0), fine = smallPyramidValues(1, 0, 0);
    const double weights[2][4] = {{0, 1, 0, 0}, {-1 / 16., 9 / 16., 9 / 16., -1 / 16.}};
    for (int y = 0; y < 13; ++y)
        for (int x = 0; x < 13; ++x) {
            double expected = fine[y * 13 + x];
            for (int b = 0; b < 4; ++b)
                for (int a = 0; a < 4; ++a) {
                    const double weight = weights[x % 2][a] * weights[y % 2][b];
                    if (weight != 0) expected += weight * coarse[(y / 2 + b) * 9 + x / 2 + a];
                }
            CHECK(at(root, 13, x, y) == doctest::Approx(expected).epsilon(1e-6));
        }
    for (int i = 0; i < 4; ++i)
        CHECK(holds(tile(1, i % 2, i / 2), 13, 2, i % 2, i / 2, 1));
    CHECK_FALSE(r->hasTile({2, 0, 0}));
}

TEST_CASE_FIXTURE(ResidualFixture, "Without a file residuals are zero, down to level 32") {
    open(cpuCache("c", 29) + residuals("delta=\"2\"") +
         "<residualProducer name=\"s\" cache=\"c\" file=\"\"/>\n");
    for (const char* name : {"r", "s"}) {
        TileProducer* const producer = this->producer(name);
        REQUIRE(producer);
        CHECK(producer->hasTile({20, 77, 3}));
        CHECK(producer->hasTile({30, 77, 3}));
        CHECK_FALSE(producer->hasTile({33, 77, 3}));
        CHECK(isZero(values(make(*producer, {20, 77, 3}))));
    }
}

TEST_CASE_FIXTURE(ResidualFixture, "Nested files refine parts, at levels of the file around them") {
    write("part.dat", part().bytes());
    const std::string nested = "<residualProducerNested cache=\"c\" file=\"part.dat\" "
                               "scale=\"10\" name=\"any\"/>\n";
    open(cpuCache("c", 13) + residuals("file=\"DEM.dat\" delta=\"1\"", nested));
    TileProducer* const r = producer("r");
    REQUIRE(r);
    // Quads of level 2 read level 3 of the file: 4x4 tiles.
    for (int i = 0; i < 16; ++i)
        CHECK(r->hasTile({2, i % 4, i / 4}) == (i % 4 == 2 && i / 4 == 3));
    CHECK(at(tile(2, 2, 3), 13, 6, 6) == 100 * 2 * 10);
    CHECK(at(tile(3, 4, 6), 13, 6, 6) == 101 * 2 * 10);
    CHECK(at(tile(3, 5, 7), 13, 6, 6) == 104 * 2 * 10);
    CHECK_FALSE(r->hasTile({3, 6, 6}));
    CHECK_FALSE(r->hasTile({4, 8, 12}));
    CHECK(holds(tile(1, 1, 1), 13, 2, 1, 1, 1));
}

TEST_CASE_FIXTURE(ResidualFixture, "A sub-pyramid of its own has no delta, and few tiles") {
    open(cpuCache("c", 13) + residuals("file=\"DEM.dat\" delta=\"3\""), part().bytes());
    TileProducer* const r = producer("r");
    REQUIRE(r);
    CHECK(messages() == "unused-attribute: 'DEM.dat' is a sub-pyramid: its delta is 0\n");
    CHECK_FALSE(r->hasTile({0, 0, 0}));
    CHECK(r->hasTile({3, 2, 3}));
    CHECK_FALSE(r->hasTile({3, 3, 3}));
    CHECK(at(tile(4, 5, 6), 13, 12, 12) == 2 * 102);
}

TEST_CASE_FIXTURE(ResidualFixture,
                  "Elevations below the last residuals are upsampled and get noise") {
    write("raw.glsl", "#include \"upsample.glsl\"\n");
    const std::string elevations = "\" upsampleProg=\"raw;\" gridSize=\"4\" cache=\"";
    open(cpuCache("c", 13) + floatCache("g", 13) + floatCache("h", 13) + cpuCache("m", 13) +
         residuals("file=\"DEM.dat\" delta=\"1\"") + "<elevationProducer name=\"plain" +
         elevations + "g\" residuals=\"r\"/>\n" + "<elevationProducer name=\"noisy" + elevations +
         "h\" residuals=\"r\" noise=\"0,0,50,20\"/>\n"
         "<cpuElevationProducer name=\"cpu\" cache=\"m\" residuals=\"r\"/>\n"
         "<module name=\"raw\" version=\"330\" source=\"raw.glsl\" options=\"NO_CLAMP\"/>\n");
    for (const TileId& id :
         {TileId{0, 0, 0}, TileId{1, 1, 0}, TileId{2, 2, 1}, TileId{3, 5, 2}, TileId{4, 10, 5}}) {
        CAPTURE(id.level);
        const auto plain = texels(make(*producer("plain"), id));
        const auto noisy = texels(make(*producer("noisy"), id));
        const auto cpu = values(make(*producer("cpu"), id));
        double unlike = 0, noise = 0;
        for (std::size_t i = 0; i < cpu.size(); ++i) {
            unlike = std::max<double>(unlike, std::abs(plain[i].x - cpu[i]));
            noise = std::max<double>(noise, std::abs(noisy[i].x - plain[i].x));
        }
        CHECK(unlike < 1e-3);
        if (id.level < 2)
            CHECK(noise == 0);
        else
            CHECK(noise > 10);
    }
}

TEST_CASE_FIXTURE(ResidualFixture, "Elevations are prefetched with their residuals") {
    const std::string ahead = "<multithreadScheduler name=\"ahead\" nthreads=\"3\"/>\n"
                              "<tileCache name=\"c\" scheduler=\"ahead\"><cpuFloatTileStorage "
                              "tileSize=\"13\" channels=\"1\" capacity=\"9\"/></tileCache>\n";
    open(ahead + cpuCache("m", 13) + floatCache("g", 13) +
         residuals("file=\"DEM.dat\" delta=\"1\"") +
         "<cpuElevationProducer name=\"cpu\" cache=\"m\" residuals=\"r\"/>\n"
         "<elevationProducer name=\"gpu\" cache=\"g\" residuals=\"r\" gridSize=\"4\"/>\n");
    TileProducer* const r = producer("r");
    REQUIRE(r);
    CHECK_FALSE(producer("cpu")->isGpu());
    CHECK(producer("cpu")->border() == 2);
    CHECK_FALSE(producer("cpu")->prefetchTile({1, 1, 1}));
    CHECK_FALSE(producer("gpu")->prefetchTile({1, 0, 1}));
    r->cache().scheduler().waitIdle();
    CHECK(r->findTile({1, 1, 1}, true, true));
    CHECK(r->findTile({1, 0, 1}, true, true));
    CHECK_FALSE(r->findTile({1, 0, 0}, true, true));
}

TEST_CASE_FIXTURE(ResidualFixture, "A damaged tile is told once, and zero; the others are there") {
    TestPyramid pyramid = smallPyramid();
    pyramid.tiles[3].replace(8, 10, "0123456789");
    pyramid.tiles[4] = pyramid.tiles[0];
    open(cpuCache("c", 13, 1) + residuals("file=\"DEM.dat\""), pyramid.bytes());
    TileProducer* const r = producer("r");
    REQUIRE(r);
    for (int frame = 0; frame < 3; ++frame) { // the cache has one slot: all are read again
        for (int i = 0; i < 4; ++i) {
            CAPTURE(i);
            Tile& made = make(*r, {2, i % 2, i / 2});
            if (i == 1 || i == 2)
                CHECK(isZero(values(made)));
            else
                CHECK(holds(values(made), 13, 2, i % 2, i / 2, 1));
            r->putTile(made);
        }
    }
    REQUIRE(diagnostics.all().size() == 2);
    const std::string first = diagnostics.all()[0].message;
    CHECK(first.starts_with(
        "'DEM.dat' is damaged: tile 2/1/0: its pixels can't be decoded (ZIPDecode: "));
    CHECK(diagnostics.all()[1].message ==
          "'DEM.dat' is damaged: tile 2/0/1: it has 9x9 pixels, not 13x13");
    CHECK(diagnostics.all()[0].place.toString().ends_with("archive.xml:4:44"));
    CHECK(told() == "damaged-tile 4:44\ndamaged-tile 4:44\n");
}

TEST_CASE_FIXTURE(ResidualFixture, "A file with many damaged tiles is told a few times") {
    TestPyramid pyramid{.maxLevel = 2, .tileSize = 8};
    pyramid.tiles.assign(21, makeTiff(2, 2, {1, 2, 3, 4}));
    open(cpuCache("c", 13) + residuals("file=\"DEM.dat\""), pyramid.bytes());
    for (int i = 0; i < 16; ++i)
        CHECK(isZero(tile(2, i % 4, i / 4)));
    CHECK(diagnostics.all().size() == 9);
    CHECK(diagnostics.all().back().message == "'DEM.dat' is damaged: more tiles");
    diagnostics.clear();
}

TEST_CASE_FIXTURE(ResidualFixture,
                  "A file that is cut short while it is in use is damage, no crash") {
    const std::string bytes = smallPyramid().bytes();
    open(cpuCache("c", 13) + residuals("file=\"DEM.dat\""), bytes);
    CHECK(holds(tile(0, 0, 0), 13, 0, 0, 0, 1));
    std::filesystem::resize_file(folder.path() / "DEM.dat", 400);
    CHECK(isZero(tile(2, 1, 1)));
    CHECK(messages() == "damaged-tile: 'DEM.dat' is damaged: tile 2/1/1: the file was cut short\n");
}

TEST_CASE_FIXTURE(ResidualFixture,
                  "A file that is cut anywhere costs its residuals, not the ground") {
    const std::string bytes = smallPyramid().bytes();
    const std::string entries =
        cpuCache("c", 13) + floatCache("g", 13) + residuals("file=\"DEM.dat\" delta=\"1\"") +
        "<elevationProducer name=\"e\" cache=\"g\" residuals=\"r\" gridSize=\"4\" noise=\"10\"/>\n";
    for (std::size_t length = 0; length < bytes.size(); length += length < 80 ? 1 : 97) {
        CAPTURE(length);
        open(entries, bytes.substr(0, length));
        TileProducer* const e = producer("e");
        REQUIRE(e);
        CHECK(diagnostics.errors() == 1);
        CHECK(told() == "damaged-file 5:44\n");
        for (const TileId& id : {TileId{0, 0, 0}, TileId{1, 0, 0}, TileId{1, 1, 1}}) {
            const auto tile = texels(make(*e, id));
            CHECK(std::any_of(tile.begin(), tile.end(), [](const auto& t) { return t.x != 0; }));
        }
        CHECK(diagnostics.all().empty());
    }
}

TEST_CASE_FIXTURE(ResidualFixture, "What does not fit the file is told where the archive says it") {
    write("part.dat", part(16).bytes());
    write("small.dat", smallPyramid().bytes().replace(4, 4, littleEndian(0))); // its maxLevel
    write("garbage.dat", "This is no pyramid, but it has more bytes than a header.");
    const std::string e = "<elevationProducer name=\"e\" cache=\"g\" residuals=\"r\" "
                          "gridSize=\"4\"/>\n";
    const std::string m = "<cpuElevationProducer name=\"e\" cache=\"m\" residuals=\"r\"/>\n";
    struct Row {
        const char* name;
        std::string entries;
        const char* code;
        const char* at; ///< the text that is blamed, the last of its kind
        std::string expected;
    };
    const Row rows[] = {
        {"a cache of another size", cpuCache("c", 12) + residuals("file=\"DEM.dat\""),
         "wrong-tile-size", "12\" c", "13, the file's 8 + 5"},
        {"a cache of two channels",
         "<tileCache name=\"c\" scheduler=\"scheduler\"><cpuFloatTileStorage tileSize=\"13\" "
         "channels=\"2\" capacity=\"4\"/></tileCache>\n" +
             residuals("file=\"DEM.dat\""),
         "wrong-format", "2\" cap", "1 channel"},
        {"a cache of textures", floatCache("c", 13) + residuals("file=\"DEM.dat\""),
         "wrong-storage", "c\" f", "a cache with a cpuFloatTileStorage"},
        {"a delta too many", cpuCache("c", 13) + residuals("file=\"DEM.dat\" delta=\"2\""),
         "out-of-range", "2\"/>", "0 to 1"},
        {"a delta below the deepest level",
         cpuCache("c", 13) + residuals("file=\"small.dat\" delta=\"1\""), "out-of-range", "1\"/>",
         "0"},
        {"a missing file", cpuCache("c", 13) + residuals("file=\"DEM.da\""), "file-missing",
         "DEM.da\"", ""},
        {"no pyramid", cpuCache("c", 13) + residuals("file=\"garbage.dat\""), "damaged-file",
         "garbage", "a DEM.dat; without it, the ground has no residuals"},
        {"a part of another size",
         cpuCache("c", 13) + cpuCache("d", 21) +
             residuals("file=\"DEM.dat\"", "<residualProducer cache=\"d\" file=\"part.dat\"/>"),
         "wrong-tile-size", "part.dat", "a file with tiles of 8"},
        {"a part that is no sub-pyramid",
         cpuCache("c", 13) +
             residuals("file=\"DEM.dat\"",
                       "<residualProducer cache=\"c\" file=\"small.dat\" delta=\"0\"/>"),
         "wrong-kind", "small.dat", "a sub-pyramid with tiles of 8, whose root level is "},
        {"elevations for another delta",
         cpuCache("c", 13) + floatCache("g", 13) + residuals("file=\"DEM.dat\"") + e,
         "wrong-tile-size", "13\" nT", "9; for delta 0, 1: 9, 13"},
        {"elevations for delta 1",
         cpuCache("c", 13) + floatCache("g", 9) + residuals("file=\"DEM.dat\" delta=\"1\"") + e,
         "wrong-tile-size", "9\" nT", "13; for delta 0, 1: 9, 13"},
        {"elevations on the CPU",
         cpuCache("c", 13) + cpuCache("m", 29) + residuals("file=\"DEM.dat\" delta=\"1\"") + m,
         "wrong-tile-size", "29\" c", "13; for delta 0, 1: 9, 13"},
        {"elevations on the CPU in a cache of textures",
         cpuCache("c", 13) + floatCache("m", 13) + residuals("file=\"DEM.dat\" delta=\"1\"") + m,
         "wrong-storage", "m\" res", "a cache with a cpuFloatTileStorage"},
        {"a mesh that does not fit the file",
         cpuCache("c", 13) + floatCache("g", 13) + residuals("file=\"DEM.dat\" delta=\"1\"") +
             "<elevationProducer name=\"e\" cache=\"g\" residuals=\"r\"/>\n",
         "wrong-tile-size", "13\" nT", "24k+5, such as 29"},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.name));
        open(row.entries);
        producer(row.entries.find("name=\"e\"") == std::string::npos ? "r" : "e");
        REQUIRE(!diagnostics.all().empty());
        CHECK(diagnostics.all().front().code == row.code);
        CHECK(diagnostics.all().front().expected.starts_with(row.expected));
        const SourceFile text("", "<archive>\n<scheduler/>\n" + row.entries);
        const LineColumn place = text.position(text.text().rfind(row.at));
        CHECK(told() == row.code + (" " + std::to_string(place.line)) + ":" +
                            std::to_string(place.column) + "\n");
    }
}
