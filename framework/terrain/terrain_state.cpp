// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/terrain_state.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace terrane {

namespace {

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isFinite(const glm::dmat4& m) {
    for (int i = 0; i < 4; ++i)
        if (!isFinite(glm::dvec3(m[i])) || !std::isfinite(m[i].w)) return false;
    return true;
}

// T of the terrain reference 2.1: rows and columns 0, 1 and 3 of tangent frame * world * D. The
// camera is taken relative to the origin of the terrain in the world, so that a terrain that was
// moved there has its own centre (TRAP 23).
glm::dmat3 localToTangent(const TerrainState& state, const Deformation& deformation) {
    const glm::dmat4 turned(glm::dmat3(state.localToWorld));
    const glm::dvec3 camera(turned * glm::dvec4(state.deformedCamera, 1));
    const glm::dmat4 all = deformation.deformedToTangentFrame(camera) * turned *
                           deformation.localToDeformedDifferential(state.localCamera);
    return {glm::dvec3(all[0].x, all[0].y, all[0].w), glm::dvec3(all[1].x, all[1].y, all[1].w),
            glm::dvec3(all[3].x, all[3].y, all[3].w)};
}

} // namespace

double splitDistance(const FrustumPlanes& planes, double splitFactor, double viewportWidth) {
    constexpr double kLeast = 1.1;
    constexpr double kReferenceWidth = 1024; // pixels
    const double kReferenceHalfView = glm::radians(40.0);
    const glm::dvec3 left = glm::normalize(glm::dvec3(planes[0]));
    const glm::dvec3 right = glm::normalize(glm::dvec3(planes[1]));
    const double fieldOfView = std::acos(std::clamp(-glm::dot(left, right), -1.0, 1.0));
    const double distance = splitFactor * (viewportWidth / kReferenceWidth) *
                            std::tan(kReferenceHalfView) / std::tan(fieldOfView / 2);
    return std::isfinite(distance) ? std::max(distance, kLeast) : kLeast;
}

std::optional<TerrainState> terrainState(const TerrainView& view, const Deformation& deformation,
                                         double splitFactor, double groundHeight,
                                         double lowestGround) {
    const glm::dmat4 cameraToLocal = glm::inverse(view.localToCamera);
    TerrainState state;
    state.localToScreen = view.cameraToScreen * view.localToCamera;
    state.localToWorld = view.localToWorld;
    const bool valid = isFinite(view.localToCamera) && isFinite(cameraToLocal) &&
                       isFinite(state.localToScreen) && isFinite(view.localToWorld);
    if (!valid) return std::nullopt;

    state.deformedCamera = glm::dvec3(cameraToLocal[3]);
    state.viewer = {frustumPlanes(state.localToScreen), state.deformedCamera, lowestGround};
    state.localCamera = deformation.deformedToLocal(state.deformedCamera);
    state.cameraIsLocal = isFinite(state.localCamera);
    state.localBehind =
        deformation.deformedToLocal(glm::dvec3(cameraToLocal * glm::dvec4(0, 0, 1, 1)));
    state.distFactor = deformation.stretch(state.localCamera);
    state.splitDistance = splitDistance(state.viewer.planes, splitFactor, view.viewportWidth);
    state.groundHeight = std::isfinite(groundHeight) ? groundHeight : 0;
    state.localToTangent = localToTangent(state, deformation);
    return state;
}

} // namespace terrane
