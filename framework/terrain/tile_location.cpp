// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/tile_location.h"

#include <cstdint>

namespace terrane {

namespace {

/// Texels along the quad, from texel centre to texel centre if the size is odd.
int interiorOf(int tileSize, int border) {
    return 2 * (tileSize / 2) - 2 * border;
}

/// Of the quad, in texels from the corner of the texture.
double startOf(int tileSize, int border) {
    return border + (tileSize % 2 == 0 ? 0.0 : 0.5);
}

} // namespace

TileLocation locateTile(const TileId& tile, const TileId& quad, int tileSize, int border,
                        const Texture& pool, int layer) {
    const std::int64_t parts = std::int64_t{1} << (quad.level - tile.level);
    const double dx = quad.tx - tile.tx * parts;
    const double dy = quad.ty - tile.ty * parts;
    const int interior = interiorOf(tileSize, border);
    const double part = static_cast<double>(interior) / static_cast<double>(parts);
    const double start = startOf(tileSize, border);
    return {&pool,
            {(dx * part + start) / tileSize, (dy * part + start) / tileSize, layer},
            {part / tileSize, part / tileSize, interior}};
}

glm::dvec2 texelAt(const glm::dvec2& inQuad, int tileSize, int border) {
    return inQuad * double(interiorOf(tileSize, border)) + startOf(tileSize, border) - 0.5;
}

} // namespace terrane
