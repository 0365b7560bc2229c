// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace terrane::test {

/// How a TIFF of a tile is written. By default as the original does.
struct TiffOptions {
    bool bytePairs = true;   ///< two samples of 8 bits, else one of 16
    bool bigEndian = false;  ///< also of 16-bit samples, never of byte pairs
    int orientation = 4;     ///< 1: rows from the top; 0: no such tag
    int compression = 32946; ///< 1: none, 8 and 32946: deflate, 32773: PackBits
    int rowsPerStrip = 0;    ///< 0: one strip, without the tag
    int sampleFormat = 0;    ///< 0: no such tag
};

/// A TIFF file, written byte by byte without libtiff.
/// @param values row by row from the bottom
std::string makeTiff(int width, int height, const std::vector<std::int16_t>& values,
                     const TiffOptions& options = {});

/// A residual file (terrain reference 4.1): header, table, tiles.
struct TestPyramid {
    std::int32_t minLevel = 0, maxLevel = 0, tileSize = 0;
    std::int32_t rootLevel = 0, rootTx = 0, rootTy = 0;
    float scale = 1;
    std::vector<std::string> tiles; ///< in the order of their numbers; equal ones share their bytes

    std::string bytes() const;
};

/// A pyramid of 1 + 1 + 4 tiles: minLevel 1, maxLevel 2, n 8, of these values.
TestPyramid smallPyramid();
std::vector<std::int16_t> smallPyramidValues(int level, int tx, int ty);

std::string littleEndian(std::uint32_t value);

} // namespace terrane::test
