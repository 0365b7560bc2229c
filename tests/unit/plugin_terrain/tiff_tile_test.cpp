// SPDX-License-Identifier: BSD-3-Clause
#include "plugin_terrain/tiff_writer.h"
#include "plugins/terrain/tiff_tile.h"

#include <doctest/doctest.h>
#include <span>
#include <thread>

using namespace terrane;
using terrane::test::makeTiff;
using terrane::test::TiffOptions;

namespace {

constexpr int kWidth = 9, kHeight = 7, kLargest = 20;

std::vector<std::int16_t> someValues() {
    std::vector<std::int16_t> values;
    for (int i = 0; i < kWidth * kHeight; ++i)
        values.push_back(static_cast<std::int16_t>(i * 977 - 30000));
    return values;
}

std::optional<HeightImage> decode(const std::string& tiff, std::string& problem) {
    return decodeTiffTile(std::as_bytes(std::span(tiff)), kLargest, problem);
}

std::string replaced(std::string text, std::size_t offset, const std::string& bytes) {
    return text.replace(offset, bytes.size(), bytes);
}

// Where the directory entry of a tag stands, in a little endian file of makeTiff.
std::size_t entryOf(const std::string& tiff, int tag) {
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(tiff[i]); };
    std::size_t entry = (at(4) | at(5) << 8 | at(6) << 16) + std::size_t{2};
    while (at(entry) + 256 * at(entry + 1) != tag)
        entry += 12;
    return entry;
}

// With another value for a tag.
std::string tagged(const std::string& tiff, int tag, std::uint32_t value) {
    return replaced(tiff, entryOf(tiff, tag) + 8, test::littleEndian(value));
}

} // namespace

TEST_CASE("Tiles may be written in all the ways that TIFF has for 16-bit values") {
    struct Row {
        const char* name;
        TiffOptions options;
    };
    const Row rows[] = {
        {"as the original does", {}},
        {"one sample of 16 bits", {.bytePairs = false}},
        {"big endian", {.bytePairs = false, .bigEndian = true}},
        {"byte pairs in a big endian file", {.bigEndian = true}},
        {"rows from the top", {.orientation = 1}},
        {"16 bits from the top", {.bytePairs = false, .orientation = 1}},
        {"no orientation: rows from the bottom", {.orientation = 0}},
        {"uncompressed", {.compression = 1}},
        {"Adobe's number of deflate", {.compression = 8}},
        {"PackBits", {.compression = 32773}},
        {"strips of two rows", {.rowsPerStrip = 2}},
        {"strips of three rows, from the top", {.orientation = 1, .rowsPerStrip = 3}},
        {"one strip, which says so", {.rowsPerStrip = kHeight}},
        {"said to be signed", {.bytePairs = false, .sampleFormat = 2}},
        {"said to be unsigned", {.sampleFormat = 1}},
    };
    const auto values = someValues();
    for (const Row& row : rows) {
        CAPTURE(std::string(row.name));
        std::string problem;
        const auto image = decode(makeTiff(kWidth, kHeight, values, row.options), problem);
        CHECK(problem.empty());
        REQUIRE(image);
        CHECK(image->width == kWidth);
        CHECK(image->height == kHeight);
        CHECK(image->values == values);
    }
}

TEST_CASE("What is no tile is refused with a reason") {
    const auto values = someValues();
    const std::string good = makeTiff(kWidth, kHeight, values);
    const std::string strips = makeTiff(kWidth, kHeight, values, {.rowsPerStrip = 2});
    struct Row {
        const char* name;
        std::string tiff;
        const char* problem; ///< part of it
    };
    const Row rows[] = {
        {"nothing", "", "no TIFF"},
        {"text", "What is this?", "no TIFF"},
        {"a header only", good.substr(0, 8), "no TIFF"},
        {"half of the directory", good.substr(0, good.size() - 60), "no TIFF"},
        {"too wide", tagged(good, 256, 21), "21x7 pixels"},
        {"too high", tagged(good, 257, 40000), "9x40000 pixels"},
        {"no pixels", tagged(good, 256, 0), ""},
        {"three samples", tagged(good, 277, 3), ""},
        {"one sample of 8 bits", tagged(tagged(good, 277, 1), 258, 8), "1 samples of 8 bits"},
        {"samples apart", tagged(good, 284, 2), "apart"},
        {"floats", makeTiff(kWidth, kHeight, values, {.bytePairs = false, .sampleFormat = 3}),
         "no integers"},
        {"JPEG", tagged(good, 259, 7), "compression is 7"},
        {"a compression that nobody has", tagged(good, 259, 4711), "compression is 4711"},
        {"LZMA, which may ask for gigabytes", tagged(good, 259, 34925), "compression is 34925"},
        {"columns for rows", tagged(good, 274, 5), "orientation is 5"},
        {"pixels that are no deflate", replaced(good, 8, "garbage garbage"), "can't be decoded"},
        {"a strip beyond the end", tagged(good, 273, 0x7fffffff), "can't be decoded"},
        {"a strip of a few bytes", tagged(good, 279, 12), "can't be decoded"},
        {"a strip of gigabytes", tagged(good, 279, 0x7fffffff), ""},
        {"strips of no rows", tagged(strips, 278, 0), ""},
        {"more rows a strip than there are strips", tagged(strips, 278, 1), ""},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.name));
        std::string problem;
        const auto image = decode(row.tiff, problem);
        CAPTURE(problem);
        CHECK_FALSE(image);
        CHECK_FALSE(problem.empty());
        CHECK(problem.find(row.problem) != std::string::npos);
    }
}

TEST_CASE("A directory that comes back to itself, or lies about its counts, ends") {
    const std::string good = makeTiff(kWidth, kHeight, someValues());
    const std::size_t bits = entryOf(good, 258);
    const std::size_t directory = entryOf(good, 256) - 2;
    const std::string hostile[] = {
        replaced(good, good.size() - 4, test::littleEndian(static_cast<std::uint32_t>(directory))),
        replaced(good, bits + 4, test::littleEndian(0xffffffff)),
        replaced(good, entryOf(good, 273) + 4, test::littleEndian(0xffffffff)),
        replaced(good, entryOf(good, 279) + 4, test::littleEndian(0x10000000)),
        replaced(good, directory, "\xff\xff"),
        tagged(good, 279, 0),      // libtiff estimates the size then
        replaced(good, 2, "\x2b"), // BigTIFF
    };
    for (const std::string& tiff : hostile) {
        std::string problem;
        const auto image = decode(tiff, problem);
        if (image) CHECK(image->values == someValues());
    }
}

TEST_CASE("Cut at any byte, a tile is decoded or refused, on many threads at once") {
    const std::string good = makeTiff(kWidth, kHeight, someValues());
    const auto cutAll = [&] {
        for (std::size_t length = 0; length < good.size(); ++length) {
            std::string problem;
            const auto image = decode(good.substr(0, length), problem);
            if (image.has_value() != problem.empty()) return false;
            if (image && image->values != someValues()) return false;
        }
        return true;
    };
    std::vector<char> good4(4);
    std::vector<std::thread> threads;
    for (char& result : good4)
        threads.emplace_back([&] { result = cutAll(); });
    for (std::thread& thread : threads)
        thread.join();
    for (const char result : good4)
        CHECK(result);
}
