// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/texture.h"
#include "resource/resource.h"
#include "resource/value.h"

#include <string_view>
#include <vector>

namespace terrane {

/// Letters as a grid of tiles in a texture; the first character is the tile at the top left (ork
/// reference 2.8). Text is bytes: each is a character.
class Font : public Resource {
public:
    struct Grid {
        int columns = 1, rows = 1;         ///< tiles
        int firstChar = 0, lastChar = 255; ///< codes that have a tile
        int invalidChar = 0;               ///< shown for all others
        /// How far each character advances, in texels. One width is that of all, and cuts their
        /// tiles; of several, the last one goes for the rest, and tiles overlap.
        std::vector<int> widths{1};
    };

    /// The picture of a character, to be drawn at a height of 1.
    struct Glyph {
        float width = 0;           ///< of the picture
        float advance = 0;         ///< to the next character
        float left = 0, right = 0; ///< texture coordinates
        float bottom = 0, top = 0; ///< texture coordinates
    };

    Font(Ref<Texture> texture, Grid grid);

    const Texture& texture() const { return *texture_; }
    /// Height of a tile in texels: the size at which letters are sharpest.
    float tileHeight() const;
    Glyph glyph(unsigned char character) const;
    /// Of a text, drawn at a height of 1.
    float width(std::string_view text) const;

private:
    Ref<Texture> texture_;
    Grid grid_;
};

class Registry;
/// <font>.
void declareFont(Registry& registry);

} // namespace terrane
