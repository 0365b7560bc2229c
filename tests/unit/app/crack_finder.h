// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/image.h"

#include <array>
#include <vector>

namespace terrane {

using Colour = std::array<unsigned char, 3>;

/// What a picture of a terrain shows where it shows no terrain. Positions are pixels from the lower
/// left corner.
struct Gaps {
    struct Pixel {
        int x, y;
    };
    /// Background with terrain within two pixels on opposite sides: left and right, above and below
    /// or along a diagonal. Pixels of the sky don't count: between two peaks it has terrain on both
    /// sides, too.
    std::vector<Pixel> cracks;
    /// All background that is not sky, however wide.
    int holes = 0;
    /// Background from which background goes up to the upper edge, straight or along diagonals.
    int sky = 0;
};

/// @param picture 8-bit RGB, from a camera that is not rolled
/// @param background the colour that the picture was cleared to and that no terrain has
Gaps findGaps(const Image& picture, const Colour& background);

} // namespace terrane
