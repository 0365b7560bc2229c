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

void collect(const SceneNode& node, std::vector<TerrainNode*>& terrains) {
    for (TerrainNode* terrain : node.fieldsOf<TerrainNode>())
        terrains.push_back(terrain);
    for (const auto& child : node.children)
        collect(*child, terrains);
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

std::vector<TerrainNode*> terrainsOf(const SceneNode& root) {
    std::vector<TerrainNode*> terrains;
    collect(root, terrains);
    return terrains;
}

TerrainNode* terrainBelowCamera(const std::vector<TerrainNode*>& terrains) {
    for (TerrainNode* terrain : terrains) {
        if (isBelowCamera(*terrain)) return terrain;
    }
    return terrains.empty() ? nullptr : terrains.front();
}

std::unique_ptr<TerrainViewController> makeViewController(const SceneNode& root) {
    std::unique_ptr<TerrainViewController> controller;
    const std::vector<TerrainNode*> terrains = terrainsOf(root);
    const TerrainNode* const terrain = terrains.empty() ? nullptr : terrains.front();
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
