// SPDX-License-Identifier: BSD-3-Clause
#include "render/font.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace terrane {

Font::Font(Ref<Texture> texture, Grid grid)
    : texture_(std::move(texture))
    , grid_(std::move(grid)) {
    assert(texture_ && "Font: needs a texture");
    assert(grid_.columns > 0 && grid_.rows > 0 && !grid_.widths.empty() && "Font: empty grid");
}

float Font::tileHeight() const {
    return float(texture_->height()) / float(grid_.rows);
}

Font::Glyph Font::glyph(unsigned char character) const {
    int code = character;
    if (code < grid_.firstChar || code > grid_.lastChar)
        code = std::clamp(grid_.invalidChar, grid_.firstChar, grid_.lastChar);
    const int index = code - grid_.firstChar;
    const bool fixed = grid_.widths.size() == 1;
    const std::size_t known = std::min(std::size_t(index), grid_.widths.size() - 1);
    // Letters are as high as asked for, and as wide as if tiles were square.
    const float tileWidth = float(texture_->width()) / float(grid_.columns);
    const float advance = float(grid_.widths[known]) / tileWidth;
    const float width = fixed ? advance : 1.0F;
    const float column = float(index % grid_.columns);
    const float row = float(index / grid_.columns);
    const auto columns = float(grid_.columns);
    const auto rows = float(grid_.rows);
    return {.width = width,
            .advance = advance,
            .left = column / columns,
            .right = (column + width) / columns,
            .bottom = 1 - (row + 1) / rows,
            .top = 1 - row / rows};
}

float Font::width(std::string_view text) const {
    float sum = 0;
    for (const char character : text)
        sum += glyph(static_cast<unsigned char>(character)).advance;
    return sum;
}

} // namespace terrane
