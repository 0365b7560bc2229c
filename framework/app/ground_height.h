// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/elevation_at.h"

#include <optional>
#include <vector>

#include <glm/vec2.hpp>

namespace terrane {

class TerrainNode;
class TileSampler;

/// A place of one of the terrains of a scene.
struct TerrainPlace {
    const TerrainNode* terrain = nullptr;
    glm::dvec2 local{0}; ///< metres
};

/// The place that a script names by two numbers: of the first terrain in local metres, or, if that
/// is a face of a planet, longitude and latitude in degrees, on the face that is there. Nothing
/// when it is on no terrain. As of the last frame.
std::optional<TerrainPlace> terrainPlace(const std::vector<TerrainNode*>& terrains, double x,
                                         double y);

/// The elevation there by the elevation tiles of the terrain; see elevationAt().
std::optional<TileElevation> groundElevation(const TerrainPlace& place,
                                             const std::vector<TileSampler*>& samplers);

} // namespace terrane
