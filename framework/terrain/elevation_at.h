// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <glm/vec2.hpp>

namespace terrane {

class TerrainNode;
class TileSampler;

/// The height of the ground as a tile shows it.
struct TileElevation {
    double elevation = 0; ///< metres
    int level = 0;        ///< of the tile
};

/// Whether the tiles of a sampler hold elevations: three channels in textures, and a border of 2.
bool hasElevations(const TileSampler& sampler);

/// The elevation at a local point of a terrain, in metres, by the finest tile of the sampler's
/// producer that has data, in use or not, between its texels. Nothing when the point is beside the
/// terrain or no tile has data. Waits for the GPU: for scripts and tests. GL thread.
/// @param sampler with hasElevations()
std::optional<TileElevation> elevationAt(const TerrainNode& terrain, const TileSampler& sampler,
                                         const glm::dvec2& local);

} // namespace terrane
