// SPDX-License-Identifier: BSD-3-Clause
#include "app/ground_height.h"

#include "app/start_view.h"
#include "terrain/terrain_node.h"
#include "terrain/tile_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace terrane {

glm::dvec3 inFrameOf(const TerrainNode& terrain, const glm::dvec3& world) {
    const glm::dmat4 worldToLocal = glm::inverse(terrain.state().localToWorld);
    return glm::dvec3(worldToLocal * glm::dvec4(world, 1));
}

namespace {

bool isSphere(const TerrainNode& terrain) {
    return terrain.deformation().shape() == Deformation::Shape::sphere;
}

bool contains(const TerrainNode& terrain, const glm::dvec2& local) {
    const double size = terrain.parameters().size;
    return std::abs(local.x) <= size && std::abs(local.y) <= size;
}

glm::dvec3 direction(double longitude, double latitude) {
    const double c = std::cos(latitude);
    return {std::cos(longitude) * c, std::sin(longitude) * c, std::sin(latitude)};
}

bool isSamePlanet(const TerrainNode& a, const TerrainNode& b) {
    return isSphere(a) && isSphere(b) && a.deformation().radius() == b.deformation().radius() &&
           a.state().localToWorld[3] == b.state().localToWorld[3];
}

glm::dvec3 toLocal(const TerrainNode& terrain, const glm::dvec3& world) {
    return terrain.deformation().deformedToLocal(inFrameOf(terrain, world));
}

glm::dvec3 toWorld(const TerrainNode& terrain, const glm::dvec2& local, double height) {
    const glm::dvec3 deformed = terrain.deformation().localToDeformed(glm::dvec3(local, height));
    return glm::dvec3(terrain.state().localToWorld * glm::dvec4(deformed, 1));
}

double heightInWorld(const TerrainNode& terrain, const glm::dvec2& local, double height) {
    if (terrain.deformation().shape() != Deformation::Shape::flat) return height;
    return toWorld(terrain, local, height).z;
}

bool isOlder(const TerrainNode& a, const TerrainNode& b) {
    const auto age = [](const TerrainNode& t) {
        return t.groundSample() ? t.groundSample()->frame + 1 : 0;
    };
    return age(a) < age(b);
}

/// The terrain that told the height of the ground of this one.
TerrainNode& measuredFor(TerrainNode& terrain, const std::vector<TerrainNode*>& terrains) {
    TerrainNode* last = &terrain;
    for (TerrainNode* other : terrains)
        if (isSamePlanet(*other, terrain) && isOlder(*last, *other)) last = other;
    return *last;
}

/// The finest quad at a point whose ground was measured; the root if none was.
const TerrainQuad& measuredQuadAt(const TerrainNode& terrain, const glm::dvec2& local) {
    const TerrainQuad* quad = &terrain.leafAt(local);
    while (!quad->measured && quad->parent >= 0)
        quad = &terrain.quads()[quad->parent];
    return *quad;
}

} // namespace

std::optional<TerrainPlace> terrainPlace(const std::vector<TerrainNode*>& terrains, double x,
                                         double y) {
    if (terrains.empty()) return std::nullopt;
    const TerrainNode& first = *terrains.front();
    if (!isSphere(first)) {
        if (!contains(first, {x, y})) return std::nullopt;
        return TerrainPlace{&first, {x, y}};
    }
    const glm::dvec3 centre(first.state().localToWorld[3]);
    const glm::dvec3 world =
        centre + first.deformation().radius() * direction(glm::radians(x), glm::radians(y));
    for (const TerrainNode* terrain : terrains) {
        if (!isSamePlanet(*terrain, first)) continue;
        const glm::dvec2 local(toLocal(*terrain, world));
        if (contains(*terrain, local)) return TerrainPlace{terrain, local};
    }
    return std::nullopt;
}

glm::dvec3 inWorld(const TerrainPlace& place, double height) {
    return toWorld(*place.terrain, place.local, height);
}

TerrainNode* groundBelowCamera(const std::vector<TerrainNode*>& terrains) {
    TerrainNode* const below = terrainBelowCamera(terrains);
    return below ? &measuredFor(*below, terrains) : nullptr;
}

double groundHeightInWorld(const TerrainNode& measured) {
    const auto& sample = measured.groundSample();
    return sample ? heightInWorld(measured, sample->place, measured.groundHeight())
                  : measured.groundHeight();
}

void shareGroundHeight(const TerrainNode& measured, const std::vector<TerrainNode*>& terrains) {
    for (TerrainNode* terrain : terrains)
        if (terrain != &measured && isSamePlanet(*terrain, measured))
            terrain->setGroundHeight(measured.groundHeight());
}

double highestGround(const std::vector<TerrainNode*>& terrains, const glm::dvec3& world) {
    for (TerrainNode* terrain : terrains) {
        const glm::dvec2 local(toLocal(*terrain, world));
        if (!contains(*terrain, local)) continue;
        const TerrainNode& measured = measuredFor(*terrain, terrains);
        if (!measured.groundSample()) continue;
        const TerrainNode::GroundSample& sample = *measured.groundSample();
        const double away = glm::distance(toWorld(measured, sample.place, sample.height),
                                          toWorld(*terrain, local, sample.height));
        const TerrainQuad& quad = measuredQuadAt(*terrain, local);
        double highest = sample.height + away; // as on a slope of 45 degrees
        if (quad.measured) {
            highest = std::max(quad.zmax, sample.height);
            // Three times as steep as the quad is on the whole.
            const double steep = sample.height + 3 * (quad.zmax - quad.zmin) / quad.l * away;
            if (away <= quad.l / 4) highest = std::min(highest, steep);
        }
        return heightInWorld(*terrain, local, highest);
    }
    return -std::numeric_limits<double>::infinity();
}

std::optional<TileElevation> groundElevation(const TerrainPlace& place,
                                             const std::vector<TileSampler*>& samplers) {
    const TileSampler* best = nullptr;
    for (const TileSampler* sampler : samplers) {
        if (sampler->terrain() != place.terrain || !hasElevations(*sampler)) continue;
        if (!best || (sampler->followsCamera() && !best->followsCamera())) best = sampler;
    }
    if (!best) return std::nullopt;
    return elevationAt(*place.terrain, *best, place.local);
}

} // namespace terrane
