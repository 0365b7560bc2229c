// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/deformation_uniforms.h"
#include "terrain/random_camera.h"
#include "terrain/spherical_deformation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

using namespace terrane;
using terrane::test::Camera;
using terrane::test::Random;

namespace {

constexpr double kRadius = 6360000;

/// What a vertex shader has, in its own precision.
struct Shader {
    NodeUniforms node;
    QuadUniforms quad;

    glm::vec4 alpha(const glm::vec2& uv) const {
        return {(1 - uv.x) * (1 - uv.y), uv.x * (1 - uv.y), (1 - uv.x) * uv.y, uv.x * uv.y};
    }

    /// The formula that archives of the original have (terrain reference 2.1).
    glm::vec4 documented(const glm::vec2& uv, float h) const {
        const glm::vec4 a = alpha(uv), L = quad.screenQuadCornerNorms;
        const glm::vec4 weights = a * L / glm::dot(a, L);
        const float R = node.radius;
        const glm::vec3 P(uv * quad.offset.z + glm::vec2(quad.offset), R);
        const float k = std::min(glm::length(P) / glm::dot(a, L) * 1.0000003f, 1.0f);
        const float raised = (h + R * (1 - k)) / k;
        return (quad.screenQuadCorners + raised * quad.screenQuadVerticals) * weights;
    }

    /// deformation.glsl.
    glm::vec4 builtIn(const glm::vec2& uv, float h) const {
        const glm::vec4 a = alpha(uv), L = quad.screenQuadCornerNorms;
        const glm::vec4 weights = a * L / glm::dot(a, L);
        const float R = node.radius, l = quad.offset.z;
        const glm::vec2 p = uv * l + glm::vec2(quad.offset);
        const float normP = glm::length(glm::vec3(p, R));
        float difference = 0;
        for (int i = 0; i < 4; ++i) {
            const glm::vec2 toCorner = l * (glm::vec2(i % 2, i / 2) - uv);
            difference += a[i] * glm::dot(toCorner, 2.0f * p + toCorner) / (L[i] + normP);
        }
        const float oneMinusK = difference / glm::dot(a, L);
        const float raised = (h + R * oneMinusK) / (1 - oneMinusK);
        return (quad.screenQuadCorners + raised * quad.screenQuadVerticals) * weights;
    }
};

/// The six faces' frames in the planet's (terrain reference 2.2).
std::array<glm::dmat4, 6> faces() {
    const double quarter = glm::radians(90.0);
    const glm::dmat4 one(1);
    const glm::dmat4 up = glm::rotate(one, quarter, glm::dvec3(1, 0, 0));
    const auto about = [&](int turns) {
        return up * glm::rotate(one, turns * quarter, glm::dvec3(0, 1, 0));
    };
    return {one, up, about(1), about(2), about(3), up * up};
}

TerrainQuad quadAt(int level, int tx, int ty) {
    TerrainQuad quad;
    quad.level = level;
    quad.tx = tx;
    quad.ty = ty;
    quad.l = 2 * kRadius / std::exp2(level);
    quad.ox = -kRadius + tx * quad.l;
    quad.oy = -kRadius + ty * quad.l;
    return quad;
}

/// Metres between where a vertex of clip coordinates is seen and where it is. Depth apart, which is
/// no place.
double error(const glm::vec4& clip, const Camera& camera, const glm::dvec3& inCamera) {
    const glm::dmat4& p = camera.view.cameraToScreen;
    const glm::dvec3 seen(double(clip.x) / p[0][0], double(clip.y) / p[1][1], -double(clip.w));
    return glm::length(seen - inCamera);
}

} // namespace

TEST_CASE("Vertices of level 20 are within a centimetre of where they belong, on all six faces") {
    Random random(77);
    const SphericalDeformation sphere(kRadius);
    const auto frames = faces();
    const int last = (1 << 20) - 1;
    double documented = 0, builtIn = 0, farthest = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::dmat4& faceToWorld = frames[static_cast<std::size_t>(i % 6)];
        // Corners and edges of the faces, too.
        const auto tile = [&] {
            const int choice = random.integer(0, 5);
            return choice == 0 ? 0 : choice == 1 ? last : random.integer(0, last);
        };
        const TerrainQuad quad = quadAt(20, tile(), tile());
        const double ground = random.uniform(-9000, 9000);
        // Nearer than the quads of level 20 are drawn, up to where they are drawn.
        const glm::dvec3 eye = glm::dvec3(
            faceToWorld *
            glm::dvec4(sphere.localToDeformed({quad.ox + quad.l * random.uniform(-3, 4),
                                               quad.oy + quad.l * random.uniform(-3, 4),
                                               ground + quad.l * random.logarithmic(0.01, 3)}),
                       1));
        // The camera's frame is known in the world, and inverted, as the player does.
        Camera camera = randomCamera(random, eye);
        const glm::dmat4 cameraToWorld = glm::inverse(camera.view.localToCamera);
        camera.view.localToWorld = faceToWorld;
        camera.view.localToCamera = glm::inverse(cameraToWorld) * faceToWorld;
        const auto state = terrainState(camera.view, sphere, 2, ground, -9000);
        REQUIRE(state);
        const Shader shader{nodeUniforms(sphere, *state), quadUniforms(sphere, *state, quad)};
        for (int k = 0; k < 20; ++k) {
            const glm::vec2 uv(random.integer(0, 24) / 24.0, random.integer(0, 24) / 24.0);
            const auto h = static_cast<float>(ground + random.uniform(-20, 20));
            // The judge turns and deforms in double precision, relative to the camera.
            const glm::dvec3 world(
                faceToWorld *
                glm::dvec4(sphere.localToDeformed({quad.ox + quad.l * double(uv.x),
                                                   quad.oy + quad.l * double(uv.y), double(h)}),
                           1));
            const glm::dvec3 inCamera =
                glm::transpose(glm::dmat3(cameraToWorld)) * (world - glm::dvec3(cameraToWorld[3]));
            documented = std::max(documented, error(shader.documented(uv, h), camera, inCamera));
            builtIn = std::max(builtIn, error(shader.builtIn(uv, h), camera, inCamera));
            farthest = std::max(farthest, glm::length(inCamera));
        }
    }
    MESSAGE("errors in metres: " << documented << " documented, " << builtIn << " built-in; "
                                 << farthest << " away");
    CHECK(documented < 0.01);
    CHECK(builtIn < 0.01);
}

TEST_CASE("The built-in formula is exact to a ten-thousandth of the quad at any level") {
    Random random(78);
    const SphericalDeformation sphere(kRadius);
    for (int level = 0; level <= 20; ++level) {
        CAPTURE(level);
        double worst = 0;
        for (int i = 0; i < 300; ++i) {
            const int last = (1 << level) - 1;
            const TerrainQuad quad =
                quadAt(level, random.integer(0, last), random.integer(0, last));
            const double ground = random.uniform(0, std::min(9000.0, quad.l / 10));
            const Camera camera = randomCamera(
                random, sphere.localToDeformed({quad.ox + quad.l * random.uniform(-2, 3),
                                                quad.oy + quad.l * random.uniform(-2, 3),
                                                ground + quad.l * random.logarithmic(0.01, 3)}));
            const auto state = terrainState(camera.view, sphere, 2, ground, -9000);
            REQUIRE(state);
            const Shader shader{nodeUniforms(sphere, *state), quadUniforms(sphere, *state, quad)};
            for (int k = 0; k < 20; ++k) {
                const glm::vec2 uv(random.integer(0, 24) / 24.0, random.integer(0, 24) / 24.0);
                const auto h = static_cast<float>(ground);
                const glm::dvec3 local = sphere.localToDeformed(
                    {quad.ox + quad.l * double(uv.x), quad.oy + quad.l * double(uv.y), double(h)});
                const glm::dvec3 inCamera =
                    glm::dmat3(camera.view.localToCamera) * (local - camera.position);
                worst = std::max(worst, error(shader.builtIn(uv, h), camera, inCamera) / quad.l);
            }
        }
        CHECK(worst < 1e-4);
    }
}
