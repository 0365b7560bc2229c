// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/deformation.h"

#include <optional>

namespace terrane {

/// From where a terrain is looked at. The deformed space of the terrain is the local frame of its
/// scene node.
struct TerrainView {
    glm::dmat4 localToCamera{1};  ///< of the scene node
    glm::dmat4 cameraToScreen{1}; ///< to clip space
    glm::dmat4 localToWorld{1};   ///< of the scene node
    double viewportWidth = 1024;  ///< pixels
};

/// What a terrain knows about its viewer in one frame. All finite, but localCamera may be infinite:
/// a camera on the opposite side of a planet has no place in the local space of a face.
struct TerrainState {
    glm::dmat4 localToScreen{1}; ///< deformed space to clip space
    glm::dmat4 localToWorld{1};
    /// Maps (x,y,1), horizontal local metres from the camera, to (x,y) in the tangent plane under
    /// the camera.
    glm::dmat3 localToTangent{1};
    glm::dvec3 deformedCamera{0};
    glm::dvec3 localCamera{0};
    glm::dvec3 localBehind{0}; ///< the point of camera space (0,0,1): one unit behind the camera
    Viewer viewer;
    double distFactor = 1;      ///< Deformation::stretch at the camera: deformed / local length
    double splitDistance = 1.1; ///< a quad is split when nearer than this many times its size
    double groundHeight = 0;    ///< metres, below the camera
    bool cameraIsLocal = true;  ///< localCamera is finite
};

/// The distance, in quad sizes, at which quads are split: the factor that the author gave holds for
/// 80 degrees of horizontal field of view and 1024 pixels. At least 1.1, since neighbouring quads
/// differ by at most one level only above 1 (terrain reference 3.1).
double splitDistance(const FrustumPlanes& planes, double splitFactor, double viewportWidth);

/// Terrain reference 3.1, steps 1 to 3. Empty when the view holds what is no number, or can't be
/// inverted: then there is nothing to draw.
/// @param lowestGround elevation that no ground of the terrain is below, metres
std::optional<TerrainState> terrainState(const TerrainView& view, const Deformation& deformation,
                                         double splitFactor, double groundHeight,
                                         double lowestGround);

} // namespace terrane
