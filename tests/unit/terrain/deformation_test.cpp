// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/cylindrical_deformation.h"
#include "terrain/spherical_deformation.h"

#include "terrain/random_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

using namespace terrane;
using terrane::test::Random;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Row {
    const char* name;
    std::shared_ptr<const Deformation> deformation;
    double size; // half edge of the root quad
};

std::vector<Row> rows() {
    return {{"flat", std::make_shared<Deformation>(), 50000},
            {"planet", std::make_shared<SphericalDeformation>(6360000), 6360000},
            {"marble", std::make_shared<SphericalDeformation>(0.5), 0.5},
            {"pipe", std::make_shared<CylindricalDeformation>(20000), 60000}};
}

bool isFinite(const glm::dmat4& m) {
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k)
            if (!std::isfinite(m[i][k])) return false;
    return true;
}

double distance(const glm::dmat3& a, const glm::dmat3& b) {
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        largest = std::max(largest, glm::length(a[i] - b[i]));
    return largest;
}

// Is a sampled point of a box really seen? Inside of the frustum but for the far plane, and not
// behind the ball of the lowest ground.
bool isSeen(const glm::dmat4& toScreen, const glm::dvec3& camera, double ball,
            const glm::dvec3& p) {
    const glm::dvec4 c = toScreen * glm::dvec4(p, 1);
    const double margin = 1e-9 * (std::abs(c.x) + std::abs(c.y) + std::abs(c.w));
    const bool inside =
        c.w - std::abs(c.x) > margin && c.w - std::abs(c.y) > margin && c.w + c.z > margin;
    if (!inside || ball <= 0) return inside;
    const glm::dvec3 d = p - camera;
    const double t = glm::clamp(-glm::dot(camera, d) / glm::dot(d, d), 0.0, 1.0);
    return glm::length(camera + t * d) > ball * (1 + 1e-9);
}

} // namespace

TEST_CASE("Deforming there and back gives the same point") {
    Random random(1);
    for (const Row& row : rows()) {
        CAPTURE(row.name);
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 p(random.uniform(-1, 1) * row.size, random.uniform(-1, 1) * row.size,
                               random.uniform(-0.2, 0.3) * std::min(row.size, 20000.0));
            const glm::dvec3 q = row.deformation->localToDeformed(p);
            const glm::dvec3 back = row.deformation->deformedToLocal(q);
            CHECK(glm::length(back - p) < 1e-14 * row.size * 100);
        }
    }
}

TEST_CASE("A planet unfolds like a cube") {
    const double R = 1000;
    const SphericalDeformation sphere(R);
    struct Side {
        const char* name;
        glm::dvec3 direction;
        glm::dvec2 centre;
    };
    const std::vector<Side> sides{{"top", {0, 0, 1}, {0, 0}},
                                  {"east", {1, 0, 0}, {2 * R, 0}},
                                  {"west", {-1, 0, 0}, {-2 * R, 0}},
                                  {"north", {0, 1, 0}, {0, 2 * R}},
                                  {"south", {0, -1, 0}, {0, -2 * R}}};
    for (const Side& side : sides) {
        CAPTURE(side.name);
        const glm::dvec3 p = sphere.deformedToLocal(side.direction * (R + 5));
        CHECK(glm::length(p - glm::dvec3(side.centre, 5)) < 1e-9);
        CHECK(glm::length(glm::dvec2(sphere.wrapped(p))) < 1e-9);
        // Coordinates run on across the edge of the square.
        const glm::dvec3 edge = glm::normalize(glm::dvec3(0, 0, 1) + side.direction);
        const glm::dvec3 here = sphere.deformedToLocal(R * edge + glm::dvec3(0, 0, 1e-7));
        const glm::dvec3 beyond = sphere.deformedToLocal(R * edge - glm::dvec3(0, 0, 1e-7));
        CHECK(glm::length(here - beyond) < 1e-5);
    }
    CHECK(sphere.deformedToLocal({1, 2, -500}) == glm::dvec3(kInfinity));
    CHECK(sphere.deformedToLocal({0, 0, 0}) == glm::dvec3(0, 0, -R));
}

TEST_CASE("A cylinder has its ground below and its axis above") {
    const CylindricalDeformation pipe(100);
    CHECK(pipe.localToDeformed({7, 0, 0}) == glm::dvec3(7, 0, -100));
    CHECK(pipe.localToDeformed({7, 0, 100}) == glm::dvec3(7, 0, 0));
    CHECK(glm::length(pipe.localToDeformed({0, 50 * std::acos(-1.0), 0}) - glm::dvec3(0, 100, 0)) <
          1e-12);
}

TEST_CASE("Differentials agree with finite differences") {
    Random random(2);
    for (const Row& row : rows()) {
        CAPTURE(row.name);
        for (int i = 0; i < 300; ++i) {
            const glm::dvec3 p(random.uniform(-1, 1) * row.size, random.uniform(-1, 1) * row.size,
                               0);
            const glm::dmat4 D =
                row.deformation->localToDeformedDifferential(p + glm::dvec3(0, 0, 123));
            const double step = 1e-5 * row.size;
            for (int k = 0; k < 3; ++k) {
                glm::dvec3 d(0);
                d[k] = step;
                const glm::dvec3 slope = (row.deformation->localToDeformed(p + d) -
                                          row.deformation->localToDeformed(p - d)) /
                                         (2 * step);
                CHECK(glm::length(slope - glm::dvec3(D[k])) < 1e-8);
            }
            const glm::dvec3 origin(D * glm::dvec4(0, 0, 0, 1));
            CHECK(glm::length(origin - row.deformation->localToDeformed(p)) < 1e-12 * row.size);
            CHECK(row.deformation->stretch(p) ==
                  doctest::Approx(
                      std::max(glm::length(glm::dvec3(D[0])), glm::length(glm::dvec3(D[1])))));
        }
    }
}

TEST_CASE("Tangent frames are orthonormal, stand on the ground and look up") {
    Random random(3);
    for (const Row& row : rows()) {
        CAPTURE(row.name);
        for (int i = 0; i < 300; ++i) {
            const glm::dvec3 ground(random.uniform(-1, 1) * row.size,
                                    random.uniform(-1, 1) * row.size, 0);
            const double height = random.uniform(0, 0.01) * std::min(row.size, 20000.0);
            const glm::dvec3 q =
                row.deformation->localToDeformed(ground + glm::dvec3(0, 0, height));
            const glm::dmat4 frame = row.deformation->deformedToTangentFrame(q);
            const glm::dmat3 turn(frame);
            CHECK(distance(glm::transpose(turn) * turn, glm::dmat3(1)) < 1e-12);
            CHECK(glm::determinant(turn) == doctest::Approx(1));
            // The point is straight above the origin at its height.
            const glm::dvec3 above(frame * glm::dvec4(q, 1));
            CHECK(glm::length(above - glm::dvec3(0, 0, height)) < 1e-9 * row.size);
            // Horizontal directions of local space stay in the plane.
            const glm::dmat3 D(row.deformation->localToDeformedDifferential(ground));
            CHECK(std::abs((turn * D[0]).z) < 1e-9);
            CHECK(std::abs((turn * D[1]).z) < 1e-9);
        }
    }
}

TEST_CASE("Points where a deformation breaks down give finite frames") {
    for (const Row& row : rows()) {
        CAPTURE(row.name);
        for (const glm::dvec3& p : {glm::dvec3(kInfinity), glm::dvec3(NAN), glm::dvec3(0),
                                    glm::dvec3(1, -kInfinity, 0)}) {
            CHECK(isFinite(row.deformation->localToDeformedDifferential(p)));
            CHECK(std::isfinite(row.deformation->stretch(p)));
        }
        for (const glm::dvec3& q :
             {glm::dvec3(0), glm::dvec3(0, 5, 0), glm::dvec3(0, -5, 0), glm::dvec3(3, 0, 0)})
            CHECK(isFinite(row.deformation->deformedToTangentFrame(q)));
    }
    CHECK(SphericalDeformation(2).localToDeformedDifferential(glm::dvec3(kInfinity)) ==
          glm::dmat4(1));
}

TEST_CASE("No box with a visible point is called invisible, none that is cut is called full") {
    Random random(4);
    for (const Row& row : rows()) {
        CAPTURE(row.name);
        const double R = row.deformation->radius();
        const bool sphere = R == row.size;
        int hidden = 0;
        int full = 0;
        for (int i = 0; i < 4000; ++i) {
            const double relief = 0.02 * std::min(row.size, 20000.0);
            QuadBox box;
            box.size = 2 * row.size / (1 << random.integer(0, 7));
            const int last = static_cast<int>(2 * row.size / box.size) - 1;
            box.x = -row.size + box.size * random.integer(0, last);
            box.y = -row.size + box.size * random.integer(0, last);
            box.zmin = random.uniform(-relief, relief);
            box.zmax = box.zmin + random.uniform(0, relief);

            // Half of the cameras are near the box.
            test::Camera camera = sphere   ? randomPlanetCamera(random, R)
                                  : R == 0 ? randomFlatCamera(random, row.size)
                                           : randomPipeCamera(random, R, row.size);
            if (i % 2 == 0)
                camera = randomCamera(random, row.deformation->localToDeformed(
                                                  {box.x + box.size * random.uniform(-1, 2),
                                                   box.y + box.size * random.uniform(-1, 2),
                                                   box.zmax + random.logarithmic(1e-3, 1) *
                                                                  std::min(box.size, relief * 9)}));
            const glm::dmat4 toScreen = camera.view.cameraToScreen * camera.view.localToCamera;
            const double lowest = -relief;
            const Viewer viewer{frustumPlanes(toScreen), camera.position, lowest};
            const Visibility visibility = row.deformation->visibility(viewer, box);
            if (visibility == Visibility::partial) continue;
            (visibility == Visibility::none ? hidden : full) += 1;
            const double ball = sphere && visibility == Visibility::none ? R + lowest : 0;
            for (int k = 0; k < 60; ++k) {
                const auto side = [&] {
                    const int choice = random.integer(0, 3);
                    return choice < 2 ? choice : random.uniform(0, 1);
                };
                const glm::dvec3 p(box.x + box.size * side(), box.y + box.size * side(),
                                   box.zmin + (box.zmax - box.zmin) * side());
                const bool seen =
                    isSeen(toScreen, camera.position, ball, row.deformation->localToDeformed(p));
                if (visibility == Visibility::none) CHECK_FALSE(seen);
                // Margins apart, a full box has no point outside.
                else if (random.integer(0, 9) == 0)
                    CHECK(terrane::visibility(viewer.planes,
                                              std::vector{row.deformation->localToDeformed(p)}) !=
                          Visibility::none);
            }
        }
        // The test saw both cases.
        CHECK(hidden > 500);
        CHECK(full > 10);
    }
}

TEST_CASE("The far side of a planet is invisible") {
    const double R = 6360000;
    const SphericalDeformation sphere(R);
    const test::Camera camera = test::cameraAt({0, 0, -R - 1e6}, {0, 0, 0});
    const Viewer viewer{frustumPlanes(camera.view.cameraToScreen * camera.view.localToCamera),
                        camera.position, 0};
    CHECK(sphere.visibility(viewer, {-R, -R, 2 * R, 0, 10000}) == Visibility::none);
    // From below the ground there is no horizon.
    const test::Camera inside = test::cameraAt({0, 0, -0.9 * R}, {0, 0, 0});
    const Viewer mole{frustumPlanes(inside.view.cameraToScreen * inside.view.localToCamera),
                      inside.position, 0};
    CHECK(sphere.visibility(mole, {-R, -R, 2 * R, 0, 10000}) != Visibility::none);
}
