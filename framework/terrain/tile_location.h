// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/tile_id.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace terrane {

class Texture;

/// The fields of the GLSL struct `samplerTile` for one quad (terrain reference 2.3).
struct TileLocation {
    const Texture* pool = nullptr; ///< the array texture; null when there is no tile
    glm::vec3 coords{0};           ///< (u0, v0, layer)
    glm::vec3 size{0};             ///< (du, dv, interior pixels of a full tile)
};

/// Where the part of a tile that covers one of its descendants lies in its texture. Borders are
/// never sampled: [0,1] spans the interior, from texel centre to texel centre in tiles of odd size,
/// from edge to edge in those of even size.
/// @param tile the tile that is there, `quad` itself or an ancestor
/// @param tileSize edge of the stored tile in pixels, borders included
TileLocation locateTile(const TileId& tile, const TileId& quad, int tileSize, int border,
                        const Texture& pool, int layer);

/// Where a point of a tile's quad, x and y in [0,1], lies between its texels: (0,0) is the centre
/// of the lower left one, borders included.
glm::dvec2 texelAt(const glm::dvec2& inQuad, int tileSize, int border);

} // namespace terrane
