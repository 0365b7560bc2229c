// SPDX-License-Identifier: BSD-3-Clause
#include "app/start_view.h"

#include "scene/scene_node.h"
#include "terrain/terrain_node.h"
#include "terrain/tile_sampler.h"

#include <algorithm>
#include <cmath>

namespace terrane {

namespace {

template <class T>
void collect(const SceneNode& node, std::vector<T*>& all) {
    for (T* found : node.fieldsOf<T>())
        all.push_back(found);
    for (const auto& child : node.children)
        collect(*child, all);
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

std::vector<TileSampler*> samplersOf(const SceneNode& root) {
    std::vector<TileSampler*> samplers;
    collect(root, samplers);
    return samplers;
}

TerrainNode* terrainBelowCamera(const std::vector<TerrainNode*>& terrains) {
    TerrainNode* first = nullptr;
    for (TerrainNode* terrain : terrains) {
        if (!terrain->isBelowCamera(terrain->root())) continue;
        if (terrain->groundSample()) return terrain;
        if (!first) first = terrain;
    }
    if (first) return first;
    return terrains.empty() ? nullptr : terrains.front();
}

namespace {

const TerrainNode* firstTerrain(const SceneNode& root) {
    const std::vector<TerrainNode*> terrains = terrainsOf(root);
    return terrains.empty() ? nullptr : terrains.front();
}

} // namespace

ViewShape viewShape(const SceneNode& root) {
    const TerrainNode* const terrain = firstTerrain(root);
    if (!terrain) return {};
    return {terrain->deformation().shape(), terrain->deformation().radius()};
}

std::unique_ptr<TerrainViewController> makeViewController(const SceneNode& root) {
    std::unique_ptr<TerrainViewController> controller;
    const TerrainNode* const terrain = firstTerrain(root);
    const auto [shape, radius] = viewShape(root);
    double d = terrain ? terrain->parameters().size : sizeOf(root.worldBounds);
    if (shape == Deformation::Shape::sphere) {
        controller = std::make_unique<PlanetViewController>(radius);
        d = 6 * radius;
    } else if (shape == Deformation::Shape::cylinder) {
        controller = std::make_unique<CylinderViewController>(radius);
        d = 0.9 * radius;
    } else {
        controller = std::make_unique<TerrainViewController>();
    }
    controller->view.d = d;
    return controller;
}

} // namespace terrane
