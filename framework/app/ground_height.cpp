// SPDX-License-Identifier: BSD-3-Clause
#include "app/ground_height.h"

#include "terrain/spherical_deformation.h"
#include "terrain/terrain_node.h"
#include "terrain/tile_sampler.h"

#include <cmath>

#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace terrane {

namespace {

bool isSphere(const TerrainNode& terrain) {
    return dynamic_cast<const SphericalDeformation*>(&terrain.deformation()) != nullptr;
}

bool contains(const TerrainNode& terrain, const glm::dvec2& local) {
    const double size = terrain.parameters().size;
    return std::abs(local.x) <= size && std::abs(local.y) <= size;
}

glm::dvec3 direction(double longitude, double latitude) {
    const double c = std::cos(latitude);
    return {std::cos(longitude) * c, std::sin(longitude) * c, std::sin(latitude)};
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
    const glm::dvec3 up = direction(glm::radians(x), glm::radians(y));
    for (const TerrainNode* terrain : terrains) {
        const bool samePlanet =
            isSphere(*terrain) && terrain->deformation().radius() == first.deformation().radius();
        if (!samePlanet) continue;
        const glm::dmat3 worldToLocal = glm::inverse(glm::dmat3(terrain->state().localToWorld));
        const glm::dvec2 local(terrain->deformation().deformedToLocal(
            worldToLocal * up * terrain->deformation().radius()));
        if (contains(*terrain, local)) return TerrainPlace{terrain, local};
    }
    return std::nullopt;
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
