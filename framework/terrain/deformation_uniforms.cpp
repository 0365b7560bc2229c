// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/deformation_uniforms.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terrane {

namespace {

// Beyond this many quad sizes a camera is far whatever the quad: shaders see the coarsest level.
// Keeps a camera at infinity (TRAP 21) out of the arithmetic of shaders.
constexpr double kFarAway = 1e9;

double clampFar(double value) {
    return std::isnan(value) ? kFarAway : std::clamp(value, -kFarAway, kFarAway);
}

float single(double value) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -kLargest, kLargest));
}

template <class Single, class Double>
Single single(const Double& value) {
    Single result;
    for (int i = 0; i < Double::length(); ++i) {
        if constexpr (requires { value[i].x; })
            for (int k = 0; k < Double::col_type::length(); ++k)
                result[i][k] = single(value[i][k]);
        else
            result[i] = single(value[i]);
    }
    return result;
}

} // namespace

NodeUniforms nodeUniforms(const Deformation& deformation, const TerrainState& state) {
    NodeUniforms uniforms;
    uniforms.blending = {single(state.splitDistance + 1), single(state.splitDistance - 1)};
    uniforms.localToScreen = single<glm::mat4>(state.localToScreen);
    uniforms.radius = single(deformation.radius());
    uniforms.localToWorld = single<glm::mat4>(state.localToWorld);
    return uniforms;
}

namespace {

void setCorners(QuadUniforms& uniforms, const Deformation& deformation, const TerrainState& state,
                const TerrainQuad& quad) {
    glm::dmat4 corners;
    glm::dmat4 verticals;
    for (int i = 0; i < 4; ++i) {
        const QuadCorner corner =
            deformation.corner({quad.ox + quad.l * (i % 2), quad.oy + quad.l * (i / 2)});
        corners[i] = state.localToScreen * glm::dvec4(corner.position, 1);
        verticals[i] = state.localToScreen * glm::dvec4(corner.vertical, 0);
        uniforms.screenQuadCornerNorms[i] = single(corner.norm);
    }
    uniforms.screenQuadCorners = single<glm::mat4>(corners);
    uniforms.screenQuadVerticals = single<glm::mat4>(verticals);
}

} // namespace

QuadUniforms quadUniforms(const Deformation& deformation, const TerrainState& state,
                          const TerrainQuad& quad, const QuadUniformNeeds& needs) {
    QuadUniforms uniforms;
    uniforms.offset = single<glm::vec4>(glm::dvec4(quad.ox, quad.oy, quad.l, quad.level));

    const glm::dvec3& c = state.localCamera;
    const double x = clampFar((c.x - quad.ox) / quad.l);
    const double y = clampFar((c.y - quad.oy) / quad.l);
    const double above = clampFar((c.z - state.groundHeight) / (quad.l * state.distFactor));
    const double elevation = std::isfinite(c.z) ? c.z : kFarAway * quad.l;
    uniforms.camera = single<glm::vec4>(glm::dvec4(x, y, above, elevation));

    if (needs.tileToTangent) {
        const glm::dmat3 tileToLocal{{quad.l, 0, 0}, {0, quad.l, 0}, {-x * quad.l, -y * quad.l, 1}};
        uniforms.tileToTangent = single<glm::mat3>(state.localToTangent * tileToLocal);
    }
    if (needs.corners) setCorners(uniforms, deformation, state, quad);
    if (needs.tangentFrameToWorld) {
        uniforms.tangentFrameToWorld =
            single<glm::mat3>(glm::dmat3(state.localToWorld) * deformation.quadFrame(quad.box()));
    }
    return uniforms;
}

} // namespace terrane
