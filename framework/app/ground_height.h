// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/elevation_at.h"

#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace terrane {

class TerrainNode;
class TileSampler;

/// A place of one of the terrains of a scene.
struct TerrainPlace {
    const TerrainNode* terrain = nullptr;
    glm::dvec2 local{0}; ///< metres
};

/// A point of the world in the frame of a terrain's node, where its deformation puts the ground.
/// As of the last frame.
glm::dvec3 inFrameOf(const TerrainNode& terrain, const glm::dvec3& world);

/// The place that a script names by two numbers: of the first terrain in local metres, or, if that
/// is a face of a planet, longitude and latitude in degrees, on the face that is there. Nothing
/// when it is on no terrain. As of the last frame.
std::optional<TerrainPlace> terrainPlace(const std::vector<TerrainNode*>& terrains, double x,
                                         double y);

/// The point of the world at a place, so high above the undisturbed ground. As of the last frame.
glm::dvec3 inWorld(const TerrainPlace& place, double height);

/// The elevation there by the elevation tiles of the terrain; see elevationAt().
std::optional<TileElevation> groundElevation(const TerrainPlace& place,
                                             const std::vector<TileSampler*>& samplers);

/// The terrain whose last measurement tells the height of the ground below the camera: that which
/// the camera is above, or the face of the same planet that was measured last. Null without any.
TerrainNode* groundBelowCamera(const std::vector<TerrainNode*>& terrains);

/// The height that a view controller takes for that of the ground below the camera, metres: of
/// a flat terrain in the world, where its node may have put it higher; else above sphere or
/// cylinder.
double groundHeightInWorld(const TerrainNode& measured);

/// Tells the other faces of a planet how high the ground is below the camera, so that they are
/// divided as finely along its edges.
void shareGroundHeight(const TerrainNode& measured, const std::vector<TerrainNode*>& terrains);

/// How high the ground may be below a point of the world, metres: what was measured near it and,
/// farther away, what is known of the quad that is there. Minus infinity when nothing is known. As
/// of the last frame.
double highestGround(const std::vector<TerrainNode*>& terrains, const glm::dvec3& world);

} // namespace terrane
