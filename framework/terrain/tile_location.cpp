// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/tile_location.h"

#include <cstdint>

namespace terrane {

TileLocation locateTile(const TileId& tile, const TileId& quad, int tileSize, int border,
                        const Texture& pool, int layer) {
    const std::int64_t parts = std::int64_t{1} << (quad.level - tile.level);
    const double dx = quad.tx - tile.tx * parts;
    const double dy = quad.ty - tile.ty * parts;
    const int interior = 2 * (tileSize / 2) - 2 * border;
    const double part = static_cast<double>(interior) / static_cast<double>(parts);
    const double start = border + (tileSize % 2 == 0 ? 0.0 : 0.5);
    return {&pool,
            {(dx * part + start) / tileSize, (dy * part + start) / tileSize, layer},
            {part / tileSize, part / tileSize, interior}};
}

} // namespace terrane
