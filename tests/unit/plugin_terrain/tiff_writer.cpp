// SPDX-License-Identifier: BSD-3-Clause
#include "plugin_terrain/tiff_writer.h"

#include <algorithm>
#include <bit>
#include <map>
#include <zlib.h>

namespace terrane::test {

namespace {

std::string number(std::uint32_t value, int bytes, bool bigEndian) {
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += static_cast<char>(value >> 8 * (bigEndian ? bytes - 1 - i : i));
    return text;
}

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string result(size, '\0');
    compress(reinterpret_cast<Bytef*>(result.data()), &size,
             reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    result.resize(size);
    return result;
}

// Literal runs only.
std::string packed(const std::string& bytes) {
    std::string result;
    for (std::size_t i = 0; i < bytes.size(); i += 128) {
        const std::string run = bytes.substr(i, 128);
        result += static_cast<char>(run.size() - 1);
        result += run;
    }
    return result;
}

std::string compressed(const std::string& bytes, int compression) {
    switch (compression) {
    case 8:
    case 32946:
        return deflated(bytes);
    case 32773:
        return packed(bytes);
    default:
        return bytes;
    }
}

} // namespace

std::string littleEndian(std::uint32_t value) {
    return number(value, 4, false);
}

std::string makeTiff(int width, int height, const std::vector<std::int16_t>& values,
                     const TiffOptions& o) {
    const int rows = o.rowsPerStrip > 0 ? o.rowsPerStrip : height;
    std::string text = (o.bigEndian ? "MM" : "II") + number(42, 2, o.bigEndian) + "????";
    std::vector<std::uint32_t> offsets, sizes;
    for (int first = 0; first < height; first += rows) {
        std::string strip;
        for (int row = first; row < std::min(first + rows, height); ++row) {
            const int y = o.orientation == 1 ? height - 1 - row : row;
            for (int x = 0; x < width; ++x)
                strip += number(
                    static_cast<std::uint16_t>(values[static_cast<std::size_t>(y * width + x)]), 2,
                    o.bigEndian && !o.bytePairs);
        }
        strip = compressed(strip, o.compression);
        offsets.push_back(static_cast<std::uint32_t>(text.size()));
        sizes.push_back(static_cast<std::uint32_t>(strip.size()));
        text += strip;
    }
    // Values that don't fit into a directory entry stand before it.
    const auto outside = [&](const std::vector<std::uint32_t>& list) {
        if (list.size() == 1) return list[0];
        const auto place = static_cast<std::uint32_t>(text.size());
        for (const std::uint32_t value : list)
            text += number(value, 4, o.bigEndian);
        return place;
    };
    const std::uint32_t offsetField = outside(offsets), sizeField = outside(sizes);

    std::string directory;
    int entries = 0;
    const auto entry = [&](int tag, int type, std::size_t count, const std::string& value) {
        directory += number(static_cast<std::uint32_t>(tag), 2, o.bigEndian) +
                     number(static_cast<std::uint32_t>(type), 2, o.bigEndian) +
                     number(static_cast<std::uint32_t>(count), 4, o.bigEndian) + value +
                     std::string(4 - value.size(), '\0');
        ++entries;
    };
    const auto shorts = [&](int tag, std::vector<int> list) {
        std::string value;
        for (const int v : list)
            value += number(static_cast<std::uint32_t>(v), 2, o.bigEndian);
        entry(tag, 3, list.size(), value);
    };
    const auto longs = [&](int tag, std::size_t count, std::uint32_t value) {
        entry(tag, 4, count, number(value, 4, o.bigEndian));
    };
    shorts(256, {width});
    shorts(257, {height});
    shorts(258, o.bytePairs ? std::vector<int>{8, 8} : std::vector<int>{16});
    shorts(259, {o.compression});
    shorts(262, {1});
    longs(273, offsets.size(), offsetField);
    if (o.orientation != 0) shorts(274, {o.orientation});
    shorts(277, {o.bytePairs ? 2 : 1});
    if (o.rowsPerStrip > 0) shorts(278, {o.rowsPerStrip});
    longs(279, sizes.size(), sizeField);
    shorts(284, {1});
    if (o.sampleFormat != 0)
        shorts(339, o.bytePairs ? std::vector<int>{o.sampleFormat, o.sampleFormat}
                                : std::vector<int>{o.sampleFormat});
    text.replace(4, 4, number(static_cast<std::uint32_t>(text.size()), 4, o.bigEndian));
    return text + number(static_cast<std::uint32_t>(entries), 2, o.bigEndian) + directory +
           std::string(4, '\0');
}

std::string TestPyramid::bytes() const {
    std::string header, table, data;
    for (const std::int32_t field : {minLevel, maxLevel, tileSize, rootLevel, rootTx, rootTy})
        header += littleEndian(static_cast<std::uint32_t>(field));
    header += littleEndian(std::bit_cast<std::uint32_t>(scale));
    std::map<std::string, std::size_t> known;
    for (const std::string& tile : tiles) {
        const auto [at, added] = known.emplace(tile, data.size());
        if (added) data += tile;
        table += littleEndian(static_cast<std::uint32_t>(at->second)) +
                 littleEndian(static_cast<std::uint32_t>(at->second + tile.size()));
    }
    return header + table + data;
}

std::vector<std::int16_t> smallPyramidValues(int level, int tx, int ty) {
    const int n = level == 0 ? 4 : 8;
    std::vector<std::int16_t> values;
    for (int y = 0; y < n + 5; ++y)
        for (int x = 0; x < n + 5; ++x) {
            // The same where tiles overlap, of both signs, and more than a byte at the root.
            const int gx = tx * n + x, gy = ty * n + y;
            values.push_back(static_cast<std::int16_t>(level == 0 ? 300 * gx - 1000 + 7 * gy
                                                                  : (gx * 5 + gy * 3) % 41 - 20));
        }
    return values;
}

TestPyramid smallPyramid() {
    TestPyramid pyramid{.minLevel = 1, .maxLevel = 2, .tileSize = 8};
    pyramid.tiles.push_back(makeTiff(9, 9, smallPyramidValues(0, 0, 0)));
    pyramid.tiles.push_back(makeTiff(13, 13, smallPyramidValues(1, 0, 0)));
    for (int ty = 0; ty < 2; ++ty)
        for (int tx = 0; tx < 2; ++tx)
            pyramid.tiles.push_back(makeTiff(13, 13, smallPyramidValues(2, tx, ty)));
    return pyramid;
}

} // namespace terrane::test
