// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"
#include "plugin_terrain/residual_oracle.h"
#include "plugin_terrain/tiff_writer.h"
#include "plugins/terrain/residual_file.h"
#include "temporary_folder.h"

#include <bit>
#include <doctest/doctest.h>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>

using namespace terrane;
using terrane::test::littleEndian;
using terrane::test::ResidualOracle;
using terrane::test::TestPyramid;

namespace {

std::optional<ResidualFile> parse(const std::string& bytes, std::string& problem) {
    return ResidualFile::parse(std::as_bytes(std::span(bytes)), problem);
}

std::string withField(std::string bytes, std::size_t offset, std::uint32_t value) {
    return bytes.replace(offset, 4, littleEndian(value));
}

// All tiles of a file that is asked for any.
void readAll(const ResidualFile& file) {
    const ResidualHeader& h = file.header();
    std::string problem;
    for (int level = 0; level < 4; ++level)
        for (int ty = 0; ty < 4; ++ty)
            for (int tx = 0; tx < 4; ++tx) {
                const TileId tile{h.rootLevel + level, h.rootTx + tx, h.rootTy + ty};
                if (!file.hasTile(tile)) continue;
                const auto values = file.read(tile, problem);
                CHECK(values.empty() != problem.empty());
            }
}

} // namespace

TEST_CASE("Every tile of the shipped files is what zlib alone makes of it") {
    for (const char* name : {"rainier/DEM.dat", "proland/DEM.dat"}) {
        CAPTURE(std::string(name));
        const std::string bytes = test::testData(name);
        if (bytes.empty()) continue;
        std::string problem;
        const auto file = parse(bytes, problem);
        REQUIRE(file);
        CHECK(problem.empty());
        CHECK(file->faults().count == 0);
        const ResidualOracle oracle(bytes);
        CHECK(file->header().minLevel == 3);
        CHECK(file->header().maxLevel == oracle.maxLevel());
        CHECK(file->header().tileSize == 192);
        CHECK(file->header().scale == 1);
        std::size_t tiles = 0;
        for (int level = 0; level <= oracle.maxLevel(); ++level) {
            CHECK(file->tileSize(level) == oracle.size(level));
            for (int ty = 0; ty < oracle.side(level); ++ty)
                for (int tx = 0; tx < oracle.side(level); ++tx) {
                    REQUIRE(file->hasTile({level, tx, ty}));
                    const auto values = file->read({level, tx, ty}, problem);
                    const auto raw = oracle.tile(level, tx, ty);
                    CHECK(raw.width == file->tileSize(level) + 5);
                    CHECK(values == raw.values);
                    ++tiles;
                }
            CHECK_FALSE(file->hasTile({level, oracle.side(level), 0}));
            CHECK_FALSE(file->hasTile({level, 0, -1}));
        }
        CHECK(tiles == file->tiles());
        CHECK_FALSE(file->hasTile({oracle.maxLevel() + 1, 0, 0}));
    }
}

TEST_CASE("A sub-pyramid has tiles below its root only") {
    TestPyramid pyramid{.maxLevel = 1, .tileSize = 8, .rootLevel = 5, .rootTx = 3, .rootTy = 6};
    for (int i = 0; i < 5; ++i)
        pyramid.tiles.push_back(
            test::makeTiff(13, 13, std::vector<std::int16_t>(169, static_cast<std::int16_t>(i))));
    const std::string bytes = pyramid.bytes();
    std::string problem;
    const auto file = parse(bytes, problem);
    REQUIRE(file);
    CHECK(file->faults().count == 0);
    int tiles = 0;
    for (int level = 0; level < 9; ++level)
        for (int ty = 0; ty < 1 << level; ++ty)
            for (int tx = 0; tx < 1 << level; ++tx)
                tiles += file->hasTile({level, tx, ty});
    CHECK(tiles == 5);
    const std::pair<TileId, int> kTiles[] = {
        {{5, 3, 6}, 0}, {{6, 6, 12}, 1}, {{6, 7, 12}, 2}, {{6, 6, 13}, 3}, {{6, 7, 13}, 4}};
    for (const auto& [tile, value] : kTiles) {
        REQUIRE(file->hasTile(tile));
        const auto values = file->read(tile, problem);
        REQUIRE(values.size() == 169);
        CHECK(values[80] == value);
    }
}

TEST_CASE("A header that no pyramid has is told with the field and what it may be") {
    const std::string good = test::smallPyramid().bytes();
    struct Row {
        const char* name;
        std::string bytes;
        const char* problem;
    };
    const auto minus = static_cast<std::uint32_t>(-1);
    const Row rows[] = {
        {"empty", "", "it has 0 bytes; its header alone needs 28"},
        {"no scale", good.substr(0, 27), "it has 27 bytes; its header alone needs 28"},
        {"no table", good.substr(0, 28),
         "its header speaks of 6 tiles, whose table alone needs 76 bytes, but it has 28"},
        {"half a table", good.substr(0, 75),
         "its header speaks of 6 tiles, whose table alone needs 76 bytes, but it has 75"},
        {"negative levels", withField(good, 0, minus),
         "its number of smaller levels is -1, not 0 to 3, as often as its tile size 8 can be "
         "halved"},
        {"too many small levels", withField(good, 0, 4),
         "its number of smaller levels is 4, not 0 to 3, as often as its tile size 8 can be "
         "halved"},
        {"a negative depth", withField(good, 4, minus), "its deepest level is -1, not 0 to 16"},
        {"a depth for which there is no disk", withField(good, 4, 17),
         "its deepest level is 17, not 0 to 16"},
        {"a lying depth", withField(good, 4, 16),
         "its header speaks of 1431655766 tiles, whose table alone needs 11453246156 bytes, but it "
         "has "},
        {"no tile size", withField(good, 8, 0),
         "its tile size is 0, not an even number from 2 to 4091"},
        {"an odd tile size", withField(good, 8, 9),
         "its tile size is 9, not an even number from 2 to 4091"},
        {"a huge tile size", withField(good, 8, 0x7ffffffe),
         "its tile size is 2147483646, not an even number from 2 to 4091"},
        {"a negative root", withField(good, 12, minus), "its root level is -1, not 0 to 28"},
        {"a root too deep", withField(good, 12, 29), "its root level is 29, not 0 to 28"},
        {"a root tile outside", withField(good, 16, 1), "its root tile is 1,0, not inside level 0"},
        {"a negative root tile", withField(good, 20, minus),
         "its root tile is 0,-1, not inside level 0"},
        {"small levels of a sub-pyramid", withField(good, 12, 2),
         "it is a sub-pyramid, and has smaller levels all the same"},
        {"no scale at all",
         withField(good, 24, std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN())),
         "its scale is no number"},
        {"endless", withField(good, 24, 0x7f800000), "its scale is no number"},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.name));
        std::string problem;
        CHECK_FALSE(parse(row.bytes, problem));
        CHECK(problem.substr(0, std::string(row.problem).size()) == row.problem);
    }
}

TEST_CASE("A file may end above its small levels") {
    TestPyramid pyramid = test::smallPyramid();
    pyramid.maxLevel = 0;
    pyramid.tiles.resize(2);
    pyramid.tiles[1] = ""; // the table has an entry for the first full tile all the same
    const std::string bytes = pyramid.bytes();
    std::string problem;
    const auto file = parse(bytes, problem);
    REQUIRE(file);
    CHECK(file->faults().count == 0);
    CHECK(file->hasTile({0, 0, 0}));
    CHECK_FALSE(file->hasTile({1, 0, 0}));
    CHECK(file->read({0, 0, 0}, problem) == test::smallPyramidValues(0, 0, 0));
}

TEST_CASE("Offsets that leave the file cost their tiles, no others") {
    const std::string good = test::smallPyramid().bytes();
    const auto tile = [](std::size_t i) { return 28 + 8 * i; };
    struct Row {
        const char* name;
        std::string bytes;
        std::size_t faults;
        TileId first;
    };
    const Row rows[] = {
        {"none", good, 0, {0, 0, 0}},
        {"an end beyond the file", withField(good, tile(1) + 4, 1u << 30), 1, {1, 0, 0}},
        {"a begin after the end", withField(good, tile(4), 0xffffffff), 1, {2, 0, 1}},
        {"nothing in between",
         withField(withField(good, tile(5), 4), tile(5) + 4, 4),
         1,
         {2, 1, 1}},
        {"cut before the last tile", good.substr(0, good.size() - 1), 1, {2, 1, 1}},
        {"cut after the table", good.substr(0, 76), 6, {0, 0, 0}},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.name));
        std::string problem;
        const auto file = parse(row.bytes, problem);
        REQUIRE(file);
        const auto faults = file->faults();
        CHECK(faults.count == row.faults);
        CHECK(faults.first == row.first);
        std::size_t damaged = 0;
        for (const TileId& id : {TileId{0, 0, 0}, TileId{1, 0, 0}, TileId{2, 0, 0}, TileId{2, 1, 0},
                                 TileId{2, 0, 1}, TileId{2, 1, 1}}) {
            const auto values = file->read(id, problem);
            if (values.empty())
                ++damaged;
            else
                CHECK(values == test::smallPyramidValues(id.level, id.tx, id.ty));
        }
        CHECK(damaged == row.faults);
    }
}

TEST_CASE(
    "Tiles of the wrong size are refused, unless they are zero, as the original shares them") {
    TestPyramid pyramid = test::smallPyramid();
    pyramid.tiles[2] = pyramid.tiles[0];
    pyramid.tiles[3] = test::makeTiff(9, 9, std::vector<std::int16_t>(81, 0));
    pyramid.tiles[4] = test::makeTiff(14, 14, std::vector<std::int16_t>(196, 0));
    const std::string bytes = pyramid.bytes();
    std::string problem;
    const auto file = parse(bytes, problem);
    REQUIRE(file);
    CHECK(file->read({2, 0, 0}, problem).empty());
    CHECK(problem == "it has 9x9 pixels, not 13x13");
    CHECK(file->read({2, 1, 0}, problem) == std::vector<std::int16_t>(169, 0));
    CHECK(file->read({2, 0, 1}, problem).empty());
    CHECK(problem == "it has 14x14 pixels");
    CHECK(file->read({2, 1, 1}, problem) == test::smallPyramidValues(2, 1, 1));
}

TEST_CASE("A file that is cut short while it is read is told as such") {
    const std::string good = test::smallPyramid().bytes();
    test::TemporaryFolder folder;
    const auto path = folder.file("DEM.dat", good);
    // Of 6 tiles, whose table ends at byte 76.
    for (const std::size_t length : {0, 27, 28, 75, 76}) {
        CAPTURE(length);
        REQUIRE(writeFile(path, good));
        std::shared_ptr<const RandomAccessFile> bytes = RandomAccessFile::open(path);
        REQUIRE(bytes);
        std::filesystem::resize_file(path, length);
        std::string problem;
        const auto file = ResidualFile::parse(std::move(bytes), problem);
        REQUIRE(file.has_value() == (length == 76));
        if (file) CHECK(file->read({2, 1, 1}, problem).empty());
        CHECK(problem == "the file was cut short");
    }
}

TEST_CASE("A table that makes a tile of a whole disk is damage") {
    const std::string good = test::smallPyramid().bytes();
    test::TemporaryFolder folder;
    const auto path = folder.file("DEM.dat", withField(good, 28 + 4, 1u << 31));
    std::filesystem::resize_file(path, 3ull << 30); // a hole
    std::string problem;
    const auto file = ResidualFile::parse(RandomAccessFile::open(path), problem);
    REQUIRE(file);
    CHECK(file->read({0, 0, 0}, problem).empty());
    CHECK(problem == "it has 2147483648 bytes, more than any tile needs");
    CHECK(file->read({1, 0, 0}, problem) == test::smallPyramidValues(1, 0, 0));
}

TEST_CASE("Cut at any byte or with any byte changed, a file is read or refused") {
    const std::string good = test::smallPyramid().bytes();
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string problem;
        const std::string cut = good.substr(0, i);
        if (const auto file = parse(cut, problem)) {
            CHECK(file->faults().count > 0);
            readAll(*file);
        } else {
            CHECK_FALSE(problem.empty());
        }
        for (const char mask : {'\x01', '\x80', '\xff'}) {
            std::string changed = good;
            changed[i] = static_cast<char>(changed[i] ^ mask);
            if (const auto file = parse(changed, problem)) readAll(*file);
        }
    }
}
