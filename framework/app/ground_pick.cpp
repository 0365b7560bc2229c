// SPDX-License-Identifier: BSD-3-Clause
#include "app/ground_pick.h"

#include "app/ground_height.h"
#include "render/render_target.h"
#include "terrain/terrain_node.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace terrane {

namespace {

/// Of a planet's radius or a flat terrain's half edge: the limits of the original's examples
/// (terrain reference 6).
constexpr double kPlanetLimit = 1.1, kFlatLimit = 2;

bool isNear(const glm::dvec3& world, const TerrainNode& terrain) {
    const glm::dvec3 point = inFrameOf(terrain, world);
    const Deformation& ground = terrain.deformation();
    const double size = kFlatLimit * terrain.parameters().size;
    switch (ground.shape()) {
    case Deformation::Shape::sphere:
        return glm::length(point) < kPlanetLimit * ground.radius();
    case Deformation::Shape::cylinder:
        return std::hypot(point.y, point.z) < kPlanetLimit * ground.radius() &&
               std::abs(point.x) < size;
    case Deformation::Shape::flat:
        break;
    }
    return glm::all(glm::lessThan(glm::abs(point), glm::dvec3(size)));
}

} // namespace

std::optional<glm::dvec3> pointAt(const RenderTarget& picture, const glm::dmat4& worldFromScreen,
                                  double x, double y) {
    const int width = picture.width(), height = picture.height();
    if (!(x >= 0 && y >= 0 && x < width && y < height)) return std::nullopt;
    const auto bytes = picture.framebuffer().readPixels(int(x), height - 1 - int(y), 1, 1,
                                                        {TransferFormat::depth, TransferType::f32});
    float depth = 1;
    std::memcpy(&depth, bytes.data(), sizeof depth);
    if (depth >= 1) return std::nullopt;
    // The depth is that of the pixel's centre.
    const double px = std::floor(x) + 0.5, py = std::floor(y) + 0.5;
    const glm::dvec4 screen(2 * px / width - 1, 1 - 2 * py / height, 2.0 * depth - 1, 1);
    const glm::dvec4 world = worldFromScreen * screen;
    const glm::dvec3 point = glm::dvec3(world) / world.w;
    if (!std::isfinite(point.x + point.y + point.z)) return std::nullopt;
    return point;
}

bool isNearTerrain(const glm::dvec3& point, const std::vector<TerrainNode*>& terrains) {
    return terrains.empty() ||
           std::any_of(terrains.begin(), terrains.end(),
                       [&](const TerrainNode* terrain) { return isNear(point, *terrain); });
}

} // namespace terrane
