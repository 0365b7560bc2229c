// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace terrane {

/// Signed 16-bit values of a raster, row by row from the bottom.
struct HeightImage {
    int width = 0;
    int height = 0;
    std::vector<std::int16_t> values;
};

/// Decodes a tile of a residual pyramid: a whole TIFF file, with one sample of 16 bits or two of 8
/// that are its low and its high byte, uncompressed or compressed without loss by PackBits, LZW or
/// deflate (terrain reference 4.1). Rows count from the bottom, as in all files of Proland, unless
/// the orientation says top left.
///
/// May be called on any thread. What libtiff has to say goes into `problem`, nowhere else. Takes
/// any bytes: allocates no more than `largest` allows and the file's size.
///
/// @param largest width and height that a tile may have
/// @param problem why nothing is returned, for people: "no TIFF file"
std::optional<HeightImage> decodeTiffTile(std::span<const std::byte> bytes, int largest,
                                          std::string& problem);

} // namespace terrane
