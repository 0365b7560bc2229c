// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/terrain_node.h"

#include "terrain/brute_force_quadtree.h"
#include "terrain/cylindrical_deformation.h"
#include "terrain/deformation_uniforms.h"
#include "terrain/random_camera.h"
#include "terrain/spherical_deformation.h"
#include "tools/terrane/allocation_counter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace terrane;
using terrane::test::BruteForceQuadtree;
using terrane::test::Camera;
using terrane::test::kFlatSize;
using terrane::test::kPipeRadius;
using terrane::test::kRadius;
using terrane::test::Random;
using terrane::test::Shape;

namespace {

TerrainNode::Parameters parametersOf(Shape shape) {
    TerrainNode::Parameters p;
    p.zmin = -100;
    p.zmax = 3000;
    p.maxLevel = 7;
    p.splitFactor = 2;
    p.horizonCulling = false;
    p.size = kFlatSize;
    if (shape == Shape::sphere) {
        p.size = kRadius;
        p.deformation = std::make_shared<SphericalDeformation>(kRadius);
    } else if (shape == Shape::cylinder) {
        p.deformation = std::make_shared<CylindricalDeformation>(kPipeRadius);
    }
    return p;
}

Camera randomCameraFor(Shape shape, Random& random) {
    if (shape == Shape::sphere) return randomPlanetCamera(random, kRadius);
    if (shape == Shape::cylinder) return randomPipeCamera(random, kPipeRadius, kFlatSize);
    return randomFlatCamera(random, kFlatSize);
}

int countDifferences(const TerrainNode& terrain, const BruteForceQuadtree& expected, int maxLevel) {
    int differences = 0;
    for (int level = 0; level <= maxLevel; ++level)
        for (int ty = 0; ty < 1 << level; ++ty)
            for (int tx = 0; tx < 1 << level; ++tx) {
                const BruteForceQuadtree::Quad& e = expected.at(level, tx, ty);
                const TerrainQuad* quad = terrain.find(level, tx, ty);
                const bool same =
                    (quad != nullptr) == e.exists &&
                    (!quad || (quad->isLeaf() == e.leaf && quad->visibility == e.visibility &&
                               quad->level == level && quad->tx == tx && quad->ty == ty));
                differences += same ? 0 : 1;
            }
    return differences;
}

template <class Check>
void forEachQuad(const TerrainNode& terrain, Check check) {
    for (int i = 0; i < terrain.quads().capacity(); ++i)
        if (terrain.quads()[i].isAlive()) check(terrain.quads()[i]);
}

// The leaf at a local point.
const TerrainQuad& leafAt(const TerrainNode& terrain, double x, double y) {
    const TerrainQuad* quad = &terrain.root();
    while (!quad->isLeaf()) {
        const int east = x < quad->ox + quad->l / 2 ? 0 : 1;
        const int north = y < quad->oy + quad->l / 2 ? 0 : 1;
        quad = &terrain.child(*quad, east + 2 * north);
    }
    return *quad;
}

} // namespace

TEST_CASE("The quadtree is that of the brute-force definition for 1,000 random cameras") {
    struct Row {
        const char* name;
        Shape shape;
        unsigned seed;
        int cameras;
    };
    for (const Row& row :
         {Row{"flat", Shape::flat, 11, 1000}, Row{"sphere", Shape::sphere, 12, 1000},
          Row{"cylinder", Shape::cylinder, 13, 1000}}) {
        CAPTURE(row.name);
        Random random(row.seed);
        TerrainNode terrain(parametersOf(row.shape));
        int split = 0;
        for (int i = 0; i < row.cameras; ++i) {
            CAPTURE(i);
            const Camera camera = randomCameraFor(row.shape, random);
            const double ground = random.uniform(-500, 1500);
            const bool splitInvisible = i % 2 == 0;
            terrain.setGroundHeight(ground);
            terrain.setSplitInvisibleQuads(splitInvisible);
            REQUIRE(terrain.update(camera.view));
            const BruteForceQuadtree expected(row.shape, terrain.parameters(), camera, ground,
                                              splitInvisible);
            CHECK(terrain.state().splitDistance == doctest::Approx(expected.splitDistance()));
            CHECK(terrain.quads().size() == expected.count());
            CHECK(countDifferences(terrain, expected, terrain.parameters().maxLevel) == 0);
            split += terrain.quads().size() > 1 ? 1 : 0;
        }
        CHECK(split > row.cameras / 4);
    }
}

TEST_CASE("Quads know their places, parents and children") {
    Random random(14);
    TerrainNode terrain(parametersOf(Shape::flat));
    terrain.setSplitInvisibleQuads(true);
    for (int i = 0; i < 20; ++i) {
        terrain.update(randomFlatCamera(random, kFlatSize).view);
        int alive = 0;
        forEachQuad(terrain, [&](const TerrainQuad& quad) {
            ++alive;
            const double l = 2 * kFlatSize / (1 << quad.level);
            CHECK(quad.l == l);
            CHECK(quad.ox == quad.tx * l - kFlatSize);
            CHECK(quad.oy == quad.ty * l - kFlatSize);
            CHECK(quad.zmin == -100);
            CHECK(quad.zmax == 3000);
            CHECK(&terrain.quads()[quad.index] == &quad);
            if (quad.parent < 0) {
                CHECK(&quad == &terrain.root());
                return;
            }
            const TerrainQuad& parent = terrain.quads()[quad.parent];
            const int which = quad.tx % 2 + 2 * (quad.ty % 2);
            CHECK(&terrain.child(parent, which) == &quad);
            CHECK(quad.index == parent.firstChild + which);
        });
        CHECK(alive == terrain.quads().size());
    }
}

TEST_CASE("Leaves that touch differ by at most one level") {
    for (double splitFactor : {0.1, 1.1, 2.0}) {
        CAPTURE(splitFactor);
        Random random(15);
        TerrainNode::Parameters p = parametersOf(Shape::flat);
        p.splitFactor = splitFactor;
        p.maxLevel = 12;
        TerrainNode terrain(p);
        terrain.setSplitInvisibleQuads(true);
        int steps = 0;
        for (int i = 0; i < 100; ++i) {
            terrain.update(randomFlatCamera(random, kFlatSize).view);
            terrain.forEachLeaf([&](const TerrainQuad& leaf) {
                const double middle = leaf.l / 2;
                const double out = leaf.l * 1e-3;
                for (const glm::dvec2& d :
                     {glm::dvec2(-out, middle), glm::dvec2(leaf.l + out, middle),
                      glm::dvec2(middle, -out), glm::dvec2(middle, leaf.l + out)}) {
                    const double x = leaf.ox + d.x;
                    const double y = leaf.oy + d.y;
                    if (std::abs(x) > kFlatSize || std::abs(y) > kFlatSize) continue;
                    const int level = leafAt(terrain, x, y).level;
                    // The finer side is seen from the finer leaf, whose neighbour is no smaller.
                    if (level < leaf.level) ++steps;
                    CHECK(level >= leaf.level - 1);
                }
            });
        }
        CHECK(steps > 0);
    }
}

TEST_CASE("Leaves come front to back") {
    Random random(16);
    TerrainNode terrain(parametersOf(Shape::flat));
    terrain.setSplitInvisibleQuads(true);
    for (int i = 0; i < 50; ++i) {
        terrain.update(randomFlatCamera(random, kFlatSize).view);
        const glm::dvec3 c = terrain.state().localCamera;
        // Along a ray from the camera, each leaf begins where an earlier one ended.
        for (int k = 0; k < 20; ++k) {
            const glm::dvec2 d(random.uniform(-1, 1), random.uniform(-1, 1));
            double reached = -1;
            terrain.forEachLeaf([&](const TerrainQuad& leaf) {
                const glm::dvec2 near = (glm::dvec2(leaf.ox, leaf.oy) - glm::dvec2(c)) / d;
                const glm::dvec2 far =
                    (glm::dvec2(leaf.ox + leaf.l, leaf.oy + leaf.l) - glm::dvec2(c)) / d;
                const double enter =
                    std::max({std::min(near.x, far.x), std::min(near.y, far.y), 0.0});
                const double leave = std::min(std::max(near.x, far.x), std::max(near.y, far.y));
                if (leave <= enter * (1 + 1e-12)) return;
                CHECK(enter >= reached * (1 - 1e-12));
                reached = leave;
            });
        }
    }
}

TEST_CASE("The split distance follows lens and viewport, and is never below 1.1") {
    struct Row {
        const char* name;
        double fieldOfView, width, factor, expected;
    };
    for (const Row& row :
         {Row{"the reference", 80, 1024, 2, 2}, Row{"twice the pixels", 80, 2048, 2, 4},
          Row{"a narrow lens", 40, 1024, 2, 2 * 2.305407}, Row{"too coarse", 80, 1024, 0.5, 1.1},
          Row{"no pixels", 80, 0, 2, 1.1}, Row{"no number", 80, NAN, 2, 1.1}}) {
        CAPTURE(row.name);
        const Camera camera = test::cameraAt({0, 0, 10}, {5, 3, 0},
                                             row.fieldOfView * std::acos(-1.0) / 180, row.width);
        const FrustumPlanes planes =
            frustumPlanes(camera.view.cameraToScreen * camera.view.localToCamera);
        CHECK(splitDistance(planes, row.factor, row.width) ==
              doctest::Approx(row.expected).epsilon(1e-6));
    }
    const FrustumPlanes parallel = frustumPlanes(glm::ortho(-1.0, 1.0, -1.0, 1.0, 0.0, 10.0));
    CHECK(splitDistance(parallel, 2, 1024) == 1.1);
}

TEST_CASE("Places of dropped quads are used again and tell that they were") {
    Random random(17);
    TerrainNode terrain(parametersOf(Shape::flat));
    std::map<int, std::pair<std::uint32_t, std::array<int, 3>>> seen;
    const auto visit = [&] {
        forEachQuad(terrain, [&](const TerrainQuad& quad) {
            const std::array<int, 3> tile{quad.level, quad.tx, quad.ty};
            const auto entry = seen.find(quad.index);
            // The same generation means the same quad.
            if (entry != seen.end() && entry->second.first == quad.generation)
                CHECK(entry->second.second == tile);
            seen[quad.index] = {quad.generation, tile};
        });
    };
    for (int i = 0; i < 100; ++i) {
        terrain.update(randomFlatCamera(random, kFlatSize).view);
        visit();
    }
    // Four times the same cameras again need no more room.
    const int capacity = terrain.quads().capacity();
    for (int round = 0; round < 4; ++round) {
        Random again(17);
        for (int i = 0; i < 100; ++i)
            terrain.update(randomFlatCamera(again, kFlatSize).view);
    }
    CHECK(terrain.quads().capacity() == capacity);
}

TEST_CASE("A steady frame asks for no memory") {
    for (Shape shape : {Shape::flat, Shape::sphere, Shape::cylinder}) {
        Random random(18);
        TerrainNode::Parameters p = parametersOf(shape);
        p.horizonCulling = true;
        p.maxLevel = 12;
        TerrainNode terrain(p);
        const Camera camera = randomCameraFor(shape, random);
        const Camera other = randomCameraFor(shape, random);
        terrain.update(other.view);
        terrain.update(camera.view);
        const auto before = countedAllocations();
        terrain.update(camera.view);
        float sum = 0;
        terrain.forEachLeaf([&](const TerrainQuad& quad) {
            sum += quadUniforms(terrain.deformation(), terrain.state(), quad).offset.x;
        });
        // The tree may shrink and grow again within what it had.
        terrain.update(other.view);
        terrain.update(camera.view);
        CHECK(countedAllocations() == before);
        CHECK(std::isfinite(sum));
    }
    const auto before = countedAllocations();
    ::operator delete(::operator new(1));
    CHECK(countedAllocations() == before + (allocationsAreCounted() ? 1 : 0));
}

TEST_CASE("Views that hold no numbers give an invisible root") {
    TerrainNode terrain(parametersOf(Shape::flat));
    const TerrainView good = test::cameraAt({0, 0, 100}, {1000, 0, 0}).view;
    REQUIRE(terrain.update(good));
    REQUIRE(terrain.quads().size() > 1);
    struct Row {
        const char* name;
        TerrainView view;
    };
    std::vector<Row> rows;
    const auto add = [&](const char* name, auto change) {
        rows.push_back({name, good});
        change(rows.back().view);
    };
    add("camera is no number", [](TerrainView& v) { v.localToCamera[3][0] = NAN; });
    add("camera is infinite", [](TerrainView& v) { v.localToCamera[3][2] = INFINITY; });
    add("singular", [](TerrainView& v) { v.localToCamera = glm::dmat4(0); });
    add("projection is no number", [](TerrainView& v) { v.cameraToScreen[0][0] = NAN; });
    add("world is no number", [](TerrainView& v) { v.localToWorld[1][1] = NAN; });
    for (const Row& row : rows) {
        CAPTURE(row.name);
        terrain.update(good);
        CHECK_FALSE(terrain.update(row.view));
        CHECK(terrain.quads().size() == 1);
        CHECK_FALSE(terrain.root().isVisible());
    }
    CHECK(terrain.update(good));
    CHECK(terrain.quads().size() > 1);
    terrain.setGroundHeight(NAN);
    CHECK(terrain.groundHeight() == 0);
}

TEST_CASE("A face opposite the camera is not split and has finite uniforms") {
    TerrainNode terrain(parametersOf(Shape::sphere));
    terrain.setSplitInvisibleQuads(true);
    for (double depth : {1.0000001, 2.0, 1e5}) {
        CAPTURE(depth);
        REQUIRE(terrain.update(test::cameraAt({3, 5, -kRadius * depth}, {0, 0, 0}).view));
        CHECK_FALSE(terrain.state().cameraIsLocal);
        CHECK(terrain.state().distFactor == 1);
        CHECK(terrain.root().isLeaf());
        const QuadUniforms u = quadUniforms(terrain.deformation(), terrain.state(), terrain.root());
        for (int i = 0; i < 4; ++i) {
            CHECK(std::isfinite(u.camera[i]));
            for (int k = 0; k < 4; ++k) {
                CHECK(std::isfinite(u.screenQuadCorners[i][k]));
                CHECK(std::isfinite(u.screenQuadVerticals[i][k]));
            }
            if (i == 3) continue;
            for (int k = 0; k < 3; ++k) {
                CHECK(std::isfinite(u.tileToTangent[i][k]));
                CHECK(std::isfinite(u.tangentFrameToWorld[i][k]));
            }
        }
        // Far: shaders blend to the coarser level.
        CHECK(std::max(u.camera.x, u.camera.z) > 1e6f);
    }
}

TEST_CASE("The number of quads is limited, whatever the lens") {
    TerrainNode::Parameters p = parametersOf(Shape::flat);
    p.maxLevel = 30;
    p.maxQuads = 1000;
    TerrainNode terrain(p);
    terrain.setSplitInvisibleQuads(true);
    CHECK(terrain.update(test::cameraAt({10, 20, 5}, {100, 0, 0}, 0.001).view));
    CHECK(terrain.limitReached());
    CHECK(terrain.quads().size() <= 1000);
    CHECK(terrain.update(test::cameraAt({10, 20, 5e5}, {100, 0, 0}).view));
    CHECK_FALSE(terrain.limitReached());
}

TEST_CASE("Levels that tile coordinates can't count are not reached") {
    TerrainNode::Parameters p = parametersOf(Shape::flat);
    p.maxLevel = 1000;
    TerrainNode terrain(p);
    terrain.setSplitInvisibleQuads(true);
    CHECK(terrain.parameters().maxLevel == TerrainNode::kDeepestLevel);
    terrain.update(test::cameraAt({10, 20, 1e-9}, {100, 0, 0}).view);
    int deepest = 0;
    forEachQuad(terrain, [&](const TerrainQuad& q) { deepest = std::max(deepest, q.level); });
    CHECK(deepest == TerrainNode::kDeepestLevel);
    CHECK(terrain.find(31, 0, 0) == nullptr);
    CHECK(terrain.find(1, 2, 0) == nullptr);
}
