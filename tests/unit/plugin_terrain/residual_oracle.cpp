// SPDX-License-Identifier: BSD-3-Clause
#include "plugin_terrain/residual_oracle.h"

#include "core/files.h"

#include <cstdlib>
#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <zlib.h>

namespace terrane::test {

namespace {

std::uint32_t unsignedAt(const std::string& bytes, std::size_t offset, int count = 4) {
    REQUIRE(offset + count <= bytes.size());
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i)
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset + i])) << 8 * i;
    return value;
}

// A tag of type short or long with one value.
std::uint32_t tagOf(const std::string& tiff, std::uint32_t wanted) {
    const std::uint32_t directory = unsignedAt(tiff, 4);
    const std::uint32_t entries = unsignedAt(tiff, directory, 2);
    for (std::uint32_t i = 0; i < entries; ++i) {
        const std::size_t entry = directory + 2 + 12 * i;
        if (unsignedAt(tiff, entry, 2) != wanted) continue;
        return unsignedAt(tiff, entry + 8, unsignedAt(tiff, entry + 2, 2) == 3 ? 2 : 4);
    }
    FAIL("the TIFF has no tag " << wanted);
    return 0;
}

// Between four samples in a row, a child's sample that lies on the second or half way to the third.
double between(double a, double b, double c, double d, bool odd) {
    return odd ? (-a + 9 * b + 9 * c - d) / 16 : b;
}

} // namespace

std::string testData(const std::string& name) {
    const char* const folder = std::getenv("TERRANE_TEST_DATA");
    const auto bytes = folder ? readFile(std::filesystem::path(folder) / name) : std::nullopt;
    if (bytes) return *bytes;
    MESSAGE("skipped: no ", name, " in TERRANE_TEST_DATA");
    return {};
}

ResidualOracle::ResidualOracle(std::string bytes)
    : bytes_(std::move(bytes)) {
    REQUIRE(integer(12) == 0); // no sub-pyramid
}

int ResidualOracle::integer(std::size_t offset) const {
    return static_cast<int>(unsignedAt(bytes_, offset));
}

int ResidualOracle::size(int level) const {
    return level < minLevel() ? tileSize() >> (minLevel() - level) : tileSize();
}

int ResidualOracle::side(int level) const {
    return level < minLevel() ? 1 : 1 << (level - minLevel());
}

ResidualOracle::Raw ResidualOracle::tile(int level, int tx, int ty) const {
    std::uint32_t tiles = minLevel(), id = level;
    for (int l = minLevel(); l <= maxLevel(); ++l)
        tiles += side(l) * side(l);
    if (level >= minLevel()) {
        id = minLevel() + tx + ty * side(level);
        for (int l = minLevel(); l < level; ++l)
            id += side(l) * side(l);
    }
    const std::size_t base = 28 + 8 * std::size_t{tiles};
    const std::size_t begin = base + unsignedAt(bytes_, 28 + 8 * id);
    const std::size_t end = base + unsignedAt(bytes_, 28 + 8 * id + 4);
    REQUIRE(begin < end);
    REQUIRE(end <= bytes_.size());
    const std::string tiff = bytes_.substr(begin, end - begin);

    REQUIRE(tiff.starts_with(std::string("II*\0", 4)));
    REQUIRE(tagOf(tiff, 259) == 32946); // deflate
    REQUIRE(tagOf(tiff, 274) == 4);     // rows from the bottom
    REQUIRE(tagOf(tiff, 277) == 2);     // two samples, of 8 bits
    Raw raw{.width = static_cast<int>(tagOf(tiff, 256)), .values = {}};
    REQUIRE(tagOf(tiff, 257) == static_cast<std::uint32_t>(raw.width));
    const std::string strip = tiff.substr(tagOf(tiff, 273), tagOf(tiff, 279));
    uLongf length = 2UL * raw.width * raw.width;
    std::vector<unsigned char> pixels(length);
    REQUIRE(uncompress(pixels.data(), &length, reinterpret_cast<const Bytef*>(strip.data()),
                       strip.size()) == Z_OK);
    REQUIRE(length == pixels.size());
    for (std::size_t i = 0; i < pixels.size(); i += 2) {
        const int value = pixels[i] + 256 * pixels[i + 1];
        raw.values.push_back(static_cast<std::int16_t>(value < 32768 ? value : value - 65536));
    }
    return raw;
}

const std::vector<double>& ResidualOracle::elevations(int level, int tx, int ty) {
    const std::array<int, 3> key{level, tx, ty};
    const auto known = elevations_.find(key);
    if (known != elevations_.end()) return known->second;

    const Raw raw = tile(level, tx, ty);
    const int width = raw.width;
    float scale = 0;
    std::memcpy(&scale, bytes_.data() + 24, 4);
    std::vector<double> z(raw.values.begin(), raw.values.end());
    for (double& value : z)
        value *= static_cast<double>(scale);
    if (level > 0) {
        const bool single = side(level) == 1; // as large as the parent, twice as fine
        const auto& parent = elevations(level - 1, single ? 0 : tx / 2, single ? 0 : ty / 2);
        const int parentWidth = size(level - 1) + 5;
        const int x0 = single ? 0 : tx % 2 * (tileSize() / 2);
        const int y0 = single ? 0 : ty % 2 * (tileSize() / 2);
        const auto at = [&](int x, int y) {
            // Weight 0 beyond the last one.
            return parent[std::min(y0 + y, parentWidth - 1) * parentWidth +
                          std::min(x0 + x, parentWidth - 1)];
        };
        for (int j = 0; j < width; ++j) {
            for (int i = 0; i < width; ++i) {
                std::array<double, 4> c{};
                for (int k = 0; k < 4; ++k)
                    c[k] = between(at(i / 2, j / 2 + k), at(i / 2 + 1, j / 2 + k),
                                   at(i / 2 + 2, j / 2 + k), at(i / 2 + 3, j / 2 + k), i % 2 != 0);
                z[j * width + i] += between(c[0], c[1], c[2], c[3], j % 2 != 0);
            }
        }
    }
    return elevations_.emplace(key, std::move(z)).first->second;
}

std::vector<double> ResidualOracle::quad(int delta, int level, int tx, int ty) {
    const int n = size(delta);
    const int fileLevel = level + delta;
    const int m = tileSize() / n; // quads along the edge of a full tile
    const auto& whole = elevations(fileLevel, tx / m, ty / m);
    const int width = size(fileLevel) + 5;
    std::vector<double> z;
    for (int y = 0; y < n + 5; ++y)
        for (int x = 0; x < n + 5; ++x)
            z.push_back(whole[(ty % m * n + y) * width + tx % m * n + x]);
    return z;
}

} // namespace terrane::test
