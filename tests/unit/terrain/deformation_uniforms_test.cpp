// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/deformation_uniforms.h"

#include "terrain/cylindrical_deformation.h"
#include "terrain/random_camera.h"
#include "terrain/spherical_deformation.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace terrane;
using terrane::test::Camera;
using terrane::test::Random;

namespace {

constexpr double kPlanet = 6360000;

TerrainQuad randomQuad(Random& random, double size, int deepest) {
    TerrainQuad quad;
    quad.level = random.integer(0, deepest);
    quad.l = 2 * size / (1 << quad.level);
    quad.tx = random.integer(0, (1 << quad.level) - 1);
    quad.ty = random.integer(0, (1 << quad.level) - 1);
    quad.ox = -size + quad.tx * quad.l;
    quad.oy = -size + quad.ty * quad.l;
    return quad;
}

// A camera some quad sizes away from a quad.
Camera cameraNear(Random& random, const Deformation& deformation, const TerrainQuad& quad) {
    const glm::dvec3 p(quad.ox + quad.l * random.uniform(-1, 2),
                       quad.oy + quad.l * random.uniform(-1, 2), quad.l * random.uniform(0.1, 2));
    return randomCamera(random, deformation.localToDeformed(p));
}

TerrainState stateOf(const Camera& camera, const Deformation& deformation, double ground = 0) {
    const auto state = terrainState(camera.view, deformation, 2, ground, 0);
    REQUIRE(state.has_value());
    return *state;
}

} // namespace

TEST_CASE("Uniforms of a terrain are those of the reference") {
    Random random(31);
    const SphericalDeformation sphere(kPlanet);
    for (int i = 0; i < 100; ++i) {
        Camera camera = randomPlanetCamera(random, kPlanet);
        camera.view.localToWorld =
            glm::rotate(glm::dmat4(1), random.uniform(0, 6), random.direction());
        const TerrainState state = stateOf(camera, sphere);
        const NodeUniforms u = nodeUniforms(sphere, state);
        CHECK(u.blending ==
              glm::vec2(glm::dvec2(state.splitDistance + 1, state.splitDistance - 1)));
        CHECK(u.localToScreen == glm::mat4(camera.view.cameraToScreen * camera.view.localToCamera));
        CHECK(u.radius == static_cast<float>(kPlanet));
        CHECK(u.localToWorld == glm::mat4(camera.view.localToWorld));
    }
    CHECK(nodeUniforms(Deformation(), TerrainState()).radius == 0);
}

TEST_CASE("The camera uniform is relative to the quad") {
    Random random(32);
    const SphericalDeformation sphere(kPlanet);
    const Deformation flat;
    for (int i = 0; i < 500; ++i) {
        const bool round = i % 2 == 0;
        const Deformation& deformation = round ? static_cast<const Deformation&>(sphere) : flat;
        const TerrainQuad quad = randomQuad(random, kPlanet, 16);
        const Camera camera = cameraNear(random, deformation, quad);
        const double ground = random.uniform(-100, 3000);
        const TerrainState state = stateOf(camera, deformation, ground);
        const QuadUniforms u = quadUniforms(deformation, state, quad);
        CHECK(u.offset == glm::vec4(glm::dvec4(quad.ox, quad.oy, quad.l, quad.level)));
        if (!state.cameraIsLocal) continue;
        const glm::dvec3 c = deformation.deformedToLocal(camera.position);
        const double above = (c.z - ground) / (quad.l * deformation.stretch(c));
        CHECK(u.camera.x == doctest::Approx((c.x - quad.ox) / quad.l).epsilon(1e-6));
        CHECK(u.camera.y == doctest::Approx((c.y - quad.oy) / quad.l).epsilon(1e-6));
        CHECK(u.camera.z == doctest::Approx(above).epsilon(1e-6));
        CHECK(u.camera.w == doctest::Approx(c.z).epsilon(1e-6));
    }
}

TEST_CASE("Vertices from screen corners are those of the direct projection") {
    Random random(33);
    const SphericalDeformation sphere(kPlanet);
    const Deformation flat;
    for (int i = 0; i < 1000; ++i) {
        const bool round = i % 2 == 0;
        CAPTURE(round);
        const Deformation& deformation = round ? static_cast<const Deformation&>(sphere) : flat;
        const TerrainQuad quad = randomQuad(random, kPlanet, 16);
        const Camera camera = cameraNear(random, deformation, quad);
        const QuadUniforms uniforms = quadUniforms(deformation, stateOf(camera, deformation), quad);
        const double u = random.uniform(0, 1);
        const double v = random.uniform(0, 1);
        const double h = random.uniform(-100, 9000);

        // Terrain reference 2.1, in double precision with the single-precision uniforms.
        const double R = round ? kPlanet : 0;
        const glm::dmat4 C(uniforms.screenQuadCorners);
        const glm::dmat4 N(uniforms.screenQuadVerticals);
        const glm::dvec4 L(uniforms.screenQuadCornerNorms);
        const glm::dvec4 alpha((1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v);
        const double mean = glm::dot(alpha, L);
        const glm::dvec4 alphaPrime = alpha * L / mean;
        const glm::dvec3 P(quad.ox + u * quad.l, quad.oy + v * quad.l, R);
        const double k = round ? std::min(glm::length(P) / mean, 1.0) : 1;
        const double hPrime = (h + R * (1 - k)) / k;
        const glm::dvec4 clip = (C + hPrime * N) * alphaPrime;

        const glm::dvec3 q = deformation.localToDeformed({P.x, P.y, h});
        const glm::dvec4 expected =
            camera.view.cameraToScreen * (camera.view.localToCamera * glm::dvec4(q, 1));
        // Single precision of the corners' clip coordinates and of the norms, which count R times.
        double size = R * 1.2;
        for (int c = 0; c < 4; ++c)
            size = std::max(size, glm::length(C[c]) + std::abs(h) * glm::length(N[c]));
        CHECK(glm::length(clip - expected) < 3e-7 * size);
    }
}

TEST_CASE("Tiles map to metres of the tangent plane below the camera") {
    Random random(34);
    const SphericalDeformation sphere(kPlanet);
    const CylindricalDeformation pipe(kPlanet);
    const Deformation flat;
    for (const Deformation* deformation :
         {static_cast<const Deformation*>(&flat), static_cast<const Deformation*>(&sphere),
          static_cast<const Deformation*>(&pipe)})
        for (int i = 0; i < 200; ++i) {
            CAPTURE(deformation->radius());
            const TerrainQuad quad = randomQuad(random, kPlanet, 16);
            if (quad.level < 10) continue; // the ground must be nearly flat
            Camera camera = cameraNear(random, *deformation, quad);
            // Where the terrain stands in the world does not matter; a planet may be turned, too.
            glm::dmat4 turn(1);
            if (deformation == &sphere)
                turn = glm::rotate(turn, random.uniform(0, 6), random.direction());
            camera.view.localToWorld = glm::translate(glm::dmat4(1), {7e6, -3e6, 2e6}) * turn;
            const TerrainState state = stateOf(camera, *deformation);
            if (!state.cameraIsLocal) continue;
            if (std::abs(state.localCamera.x) > kPlanet || std::abs(state.localCamera.y) > kPlanet)
                continue; // beside the face the differential is that of the plane's continuation
            const QuadUniforms uniforms = quadUniforms(*deformation, state, quad);
            const glm::dvec3 below(glm::dvec2(state.localCamera), 0);
            const glm::dvec3 uv(random.uniform(0, 1), random.uniform(0, 1), 1);
            const glm::dvec3 tangent = glm::dmat3(uniforms.tileToTangent) * uv;

            const glm::dvec3 p(quad.ox + uv.x * quad.l, quad.oy + uv.y * quad.l, 0);
            const glm::dmat4 frame = deformation->deformedToTangentFrame(
                glm::dvec3(turn * glm::dvec4(state.deformedCamera, 1)));
            const glm::dvec3 expected(frame *
                                      (turn * glm::dvec4(deformation->localToDeformed(p), 1)));
            const double away = glm::length(p - below);
            // The second order of the curvature, and single precision.
            const double tolerance =
                1e-6 * (away + quad.l) + (deformation == &flat ? 0 : 4 * away * away / kPlanet);
            CHECK(glm::length(glm::dvec2(tangent) - glm::dvec2(expected)) < tolerance + 1e-6);
            CHECK(tangent.z == doctest::Approx(1));
        }
}

TEST_CASE("Normals of a quad are told in east, north and up at its centre") {
    Random random(35);
    const SphericalDeformation sphere(kPlanet);
    for (int i = 0; i < 100; ++i) {
        const TerrainQuad quad = randomQuad(random, kPlanet, 8);
        Camera camera = cameraNear(random, sphere, quad);
        camera.view.localToWorld =
            glm::rotate(glm::dmat4(1), random.uniform(0, 6), random.direction());
        const QuadUniforms u = quadUniforms(sphere, stateOf(camera, sphere), quad);
        const glm::dvec3 up =
            glm::normalize(glm::dvec3(quad.ox + quad.l / 2, quad.oy + quad.l / 2, kPlanet));
        const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), up));
        const glm::dmat3 expected =
            glm::dmat3(camera.view.localToWorld) * glm::dmat3(east, glm::cross(up, east), up);
        for (int k = 0; k < 3; ++k)
            CHECK(glm::length(glm::dvec3(u.tangentFrameToWorld[k]) - expected[k]) < 1e-6);
    }
}
