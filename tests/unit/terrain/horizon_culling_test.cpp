// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/horizon_buffer.h"
#include "terrain/spherical_deformation.h"
#include "terrain/terrain_node.h"

#include "terrain/random_camera.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace terrane;
using terrane::test::Camera;
using terrane::test::Random;

namespace {

constexpr double kSize = 4000;     // half edge of the terrain
constexpr int kLevels = 8;         // cells of 31 m
constexpr double kAmplitude = 250; // metres
constexpr double kWave = 2 * 3.14159265358979 / 1700;

// Hills, and the bounds of all quads above them.
class Hills {
public:
    static double height(double x, double y) {
        return kAmplitude * std::sin(kWave * x + 1) * std::sin(kWave * y + 2) +
               0.2 * kAmplitude * std::sin(3 * kWave * x);
    }

    Hills() {
        const int n = 1 << kLevels;
        const double cell = 2 * kSize / n;
        constexpr int kSamples = 4;
        // Between samples the ground rises by no more than its steepest slope allows.
        const double margin = 1.7 * kAmplitude * kWave * cell / kSamples * 0.7072;
        for (int ty = 0; ty < n; ++ty)
            for (int tx = 0; tx < n; ++tx) {
                double low = 1e9, high = -1e9;
                for (int i = 0; i <= kSamples; ++i)
                    for (int k = 0; k <= kSamples; ++k) {
                        const double h = height(-kSize + cell * (tx + double(i) / kSamples),
                                                -kSize + cell * (ty + double(k) / kSamples));
                        low = std::min(low, h);
                        high = std::max(high, h);
                    }
                for (int level = kLevels; level >= 0; --level) {
                    const int shift = kLevels - level;
                    auto [entry, isNew] = bounds_.try_emplace({level, tx >> shift, ty >> shift},
                                                              low - margin, high + margin);
                    entry->second.first = std::min(entry->second.first, low - margin);
                    entry->second.second = std::max(entry->second.second, high + margin);
                }
            }
    }

    void measure(TerrainNode& terrain) const {
        for (int i = 0; i < terrain.quads().capacity(); ++i) {
            const TerrainQuad& quad = terrain.quads()[i];
            if (!quad.isAlive()) continue;
            const auto& [low, high] = bounds_.at({quad.level, quad.tx, quad.ty});
            terrain.setElevations(i, low, high);
        }
    }

private:
    std::map<std::tuple<int, int, int>, std::pair<double, double>> bounds_;
};

// Is a point of the ground seen beyond doubt? The line of sight must keep clear of the hills by
// more than what marching in steps of 4 m may miss.
bool isClearlySeen(const Deformation& deformation, const glm::dmat4& toScreen,
                   const glm::dvec3& camera, const glm::dvec3& p) {
    const glm::dvec4 c = toScreen * glm::dvec4(p, 1);
    if (!(c.w > std::abs(c.x) && c.w > std::abs(c.y) && c.w + c.z > 0)) return false;
    const int steps = static_cast<int>(glm::length(p - camera) / 4) + 1;
    for (int i = 0; i + 1 < steps; ++i) {
        const glm::dvec3 q = deformation.deformedToLocal(glm::mix(camera, p, double(i) / steps));
        if (Hills::height(q.x, q.y) > q.z - 0.1) return false;
    }
    return true;
}

struct Shape {
    const char* name;
    std::shared_ptr<const Deformation> deformation;
};

// The ball is so small that its curvature matters from one hill to the next.
std::vector<Shape> shapes() {
    return {{"flat", std::make_shared<Deformation>()},
            {"ball", std::make_shared<SphericalDeformation>(kSize)}};
}

TerrainNode::Parameters hillParameters(bool culling,
                                       std::shared_ptr<const Deformation> deformation = nullptr) {
    TerrainNode::Parameters p;
    p.size = kSize;
    p.deformation = std::move(deformation);
    p.zmin = -400;
    p.zmax = 400;
    p.maxLevel = kLevels;
    p.horizonCulling = culling;
    return p;
}

int visibleLeaves(const TerrainNode& terrain) {
    int count = 0;
    terrain.forEachLeaf([&](const TerrainQuad& quad) { count += quad.isVisible() ? 1 : 0; });
    return count;
}

} // namespace

TEST_CASE("Horizon culling hides no ground that is seen, and hides much that is not") {
    const Hills hills;
    for (const Shape& shape : shapes()) {
        CAPTURE(std::string(shape.name));
        const Deformation& deformation = *shape.deformation;
        Random random(21);
        TerrainNode terrain(hillParameters(true, shape.deformation));
        TerrainNode plain(hillParameters(false, shape.deformation));
        int culled = 0, shown = 0, all = 0, wrong = 0;
        glm::dvec3 place(0);
        for (int i = 0; i < 120; ++i) {
            // Jumps, and small moves between them, so that flags of the last frame matter.
            if (i % 4 == 0)
                place = {random.uniform(-0.9, 0.9) * kSize, random.uniform(-0.9, 0.9) * kSize, 0};
            place += glm::dvec3(random.uniform(-20, 20), random.uniform(-20, 20), 0);
            place.z = Hills::height(place.x, place.y) + random.logarithmic(2, 100);
            const glm::dvec3 gaze(random.uniform(-1, 1), random.uniform(-1, 1),
                                  random.uniform(-0.3, 0.1));
            const glm::dvec3 position = deformation.localToDeformed(place);
            const glm::dvec3 target =
                position + glm::dmat3(deformation.localToDeformedDifferential(place)) * gaze;
            const Camera camera = test::cameraAt(position, target, random.uniform(0.8, 2.6));
            const glm::dmat4 toScreen = camera.view.cameraToScreen * camera.view.localToCamera;
            for (int frame = 0; frame < 3; ++frame) {
                terrain.update(camera.view);
                hills.measure(terrain);
                plain.update(camera.view);
                hills.measure(plain);
            }
            terrain.update(camera.view);
            plain.update(camera.view);
            all += visibleLeaves(plain);
            shown += visibleLeaves(terrain);
            terrain.forEachLeaf([&](const TerrainQuad& quad) {
                if (quad.isVisible()) return;
                ++culled;
                for (int k = 0; k < 25; ++k) {
                    const double x = quad.ox + quad.l * random.uniform(0, 1);
                    const double y = quad.oy + quad.l * random.uniform(0, 1);
                    const glm::dvec3 p = deformation.localToDeformed({x, y, Hills::height(x, y)});
                    wrong += isClearlySeen(deformation, toScreen, position, p) ? 1 : 0;
                }
            });
        }
        CHECK(wrong == 0);
        CHECK(culled > 1000);
        MESSAGE("leaves shown with horizon culling: " << shown << " of " << all);
        CHECK(shown < 0.9 * all);
    }
}

TEST_CASE("A quad that comes out from behind a hill is shown again") {
    const Hills hills;
    TerrainNode terrain(hillParameters(true));
    Random random(22);
    const glm::dvec3 valley(300, 400, Hills::height(300, 400) + 3);
    const Camera low = test::cameraAt(valley, valley + glm::dvec3(1, 0.7, 0));
    const Camera high = test::cameraAt({300, 400, 399}, {600, 610, 200});
    const Camera above = test::cameraAt({300, 400, 5000}, {600, 610, 0});
    const auto settle = [&](const Camera& camera) {
        for (int i = 0; i < 4; ++i) {
            terrain.update(camera.view);
            hills.measure(terrain);
        }
    };
    TerrainNode fresh(hillParameters(true));
    for (const Camera& then : {high, above}) {
        settle(low);
        settle(then);
        const int shown = visibleLeaves(terrain);
        for (int i = 0; i < 4; ++i) {
            fresh.update(then.view);
            hills.measure(fresh);
        }
        CHECK(shown == visibleLeaves(fresh));
    }
}

TEST_CASE("A wall hides what is lower and behind, and nothing else") {
    struct Row {
        const char* name;
        QuadBox box;
        bool hidden;
    };
    const QuadBox wall{-50, 100, 100, 20, 30}; // stands before a camera that looks along y
    const std::vector<Row> rows{
        {"behind, lower", {-10, 300, 20, 0, 15}, true},
        {"behind, reaching over it", {-10, 300, 20, 0, 60}, false},
        {"behind, up to its top edge", {-10, 400, 20, 0, 29}, true},
        {"beside", {400, 300, 20, 0, 15}, false},
        {"half behind", {60, 230, 100, 0, 15}, false},
        // The wall ends at column 170.24.
        {"past its edge, in the same column", {504.2, 1000, 0.1, 0, 5}, false},
        {"just before its edge", {490, 1000, 0.1, 0, 5}, true},
        {"beyond the buffer", {900, 300, 20, 0, 1}, false},
        {"behind the camera", {-10, -300, 20, 0, 1}, false},
        {"around the camera", {-10, -10, 20, 0, 1}, false},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        HorizonBuffer buffer;
        buffer.reset({0, 0, 10}, {0, 3});
        CHECK_FALSE(buffer.isOccluded(row.box));
        CHECK_FALSE(buffer.addOccluder(wall));
        CHECK(buffer.isOccluded(row.box) == row.hidden);
        CHECK(buffer.addOccluder(row.box) == row.hidden);
        buffer.disable();
        CHECK_FALSE(buffer.isOccluded(row.box));
    }
    HorizonBuffer buffer;
    buffer.reset({0, 0, 10}, {0, 0}); // looks straight down
    CHECK_FALSE(buffer.isActive());
    buffer.reset({0, 0, 10}, {NAN, 0});
    CHECK_FALSE(buffer.isActive());
}
