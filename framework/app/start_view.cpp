// SPDX-License-Identifier: BSD-3-Clause
#include "app/start_view.h"

#include "scene/scene_node.h"
#include "terrain/cylindrical_deformation.h"
#include "terrain/spherical_deformation.h"
#include "terrain/terrain_node.h"

#include <algorithm>
#include <cmath>

namespace terrane {

namespace {

/// Calls visit(TerrainNode&) in document order until it returns true.
template <class Visit>
bool visitTerrains(const SceneNode& node, Visit& visit) {
    for (const auto& [id, field] : node.fields) {
        auto* const terrain = dynamic_cast<TerrainNode*>(field.get());
        if (terrain && visit(*terrain)) return true;
    }
    for (const auto& child : node.children) {
        if (visitTerrains(*child, visit)) return true;
    }
    return false;
}

bool isBelowCamera(const TerrainNode& terrain) {
    const TerrainState& state = terrain.state();
    const double size = terrain.parameters().size;
    return state.cameraIsLocal && std::abs(state.localCamera.x) <= size &&
           std::abs(state.localCamera.y) <= size;
}

double sizeOf(const Box& box) {
    const glm::dvec3 extent = box.maximum - box.minimum;
    const double size = std::max({extent.x, extent.y, extent.z});
    return std::isfinite(size) && size > 0 ? size : 1;
}

} // namespace

TerrainNode* firstTerrain(const SceneNode& root) {
    TerrainNode* found = nullptr;
    auto visit = [&](TerrainNode& terrain) { return found = &terrain, true; };
    visitTerrains(root, visit);
    return found;
}

TerrainNode* terrainBelowCamera(const SceneNode& root) {
    TerrainNode* found = nullptr;
    auto visit = [&](TerrainNode& terrain) {
        const bool below = isBelowCamera(terrain);
        if (below || !found) found = &terrain;
        return below;
    };
    visitTerrains(root, visit);
    return found;
}

std::unique_ptr<TerrainViewController> makeViewController(const SceneNode& root) {
    std::unique_ptr<TerrainViewController> controller;
    const TerrainNode* const terrain = firstTerrain(root);
    const double radius = terrain ? terrain->deformation().radius() : 0;
    double d = terrain ? terrain->parameters().size : sizeOf(root.worldBounds);
    if (terrain && dynamic_cast<const SphericalDeformation*>(&terrain->deformation())) {
        controller = std::make_unique<PlanetViewController>(radius);
        d = 6 * radius;
    } else if (terrain && dynamic_cast<const CylindricalDeformation*>(&terrain->deformation())) {
        controller = std::make_unique<CylinderViewController>(radius);
        d = 0.9 * radius;
    } else {
        controller = std::make_unique<TerrainViewController>();
    }
    controller->view.d = d;
    return controller;
}

} // namespace terrane
