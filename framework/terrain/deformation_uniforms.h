// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/terrain_quad.h"
#include "terrain/terrain_state.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace terrane {

/// The fields of the GLSL struct `deformation` that are set once for a terrain and a program
/// (terrain reference 2.1). Computed in double precision.
struct NodeUniforms {
    glm::vec2 blending{0};      ///< (s + 1, s - 1) with the split distance s
    glm::mat4 localToScreen{1}; ///< deformed space to clip space
    float radius = 0;           ///< 0 when flat
    /// Shaders declare it as a mat3 for spheres, mat4 for cylinders: set what the program has.
    glm::mat4 localToWorld{1};
};

/// The fields of `deformation` that are set for each quad. All finite, wherever the camera is.
/// Shaders of flat terrains have no use for the last two, those of cylinders none for the last
/// four; the values are then those of the plane.
struct QuadUniforms {
    glm::vec4 offset{0};                ///< (ox, oy, l, level)
    glm::vec4 camera{0};                ///< relative to the quad in quad sizes, and the elevation
    glm::mat3 tileToTangent{1};         ///< (u,v,1) to metres in the tangent plane at the camera
    glm::mat4 screenQuadCorners{1};     ///< columns: corners at elevation 0 in clip space
    glm::mat4 screenQuadVerticals{1};   ///< columns: upward unit vectors there, in clip space
    glm::vec4 screenQuadCornerNorms{1}; ///< of (x,y,R) at the corners
    glm::mat3 tangentFrameToWorld{1};   ///< columns: east, north, up of the quad in world space
};

NodeUniforms nodeUniforms(const Deformation& deformation, const TerrainState& state);

/// The fields that take some computing, which few programs have all of. What isn't needed keeps its
/// initial value.
struct QuadUniformNeeds {
    bool tileToTangent = true;
    bool corners = true; ///< screenQuadCorners, screenQuadVerticals, screenQuadCornerNorms
    bool tangentFrameToWorld = true;
};
QuadUniforms quadUniforms(const Deformation& deformation, const TerrainState& state,
                          const TerrainQuad& quad, const QuadUniformNeeds& needs = {});

} // namespace terrane
