// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/deformation.h"
#include "ui/view_controller.h"

#include <memory>
#include <vector>

namespace terrane {

class SceneNode;
class TerrainNode;
class TileSampler;

/// The terrains of a scene in document order, depth first.
std::vector<TerrainNode*> terrainsOf(const SceneNode& root);

/// Their tile samplers, node by node.
std::vector<TileSampler*> samplersOf(const SceneNode& root);

/// The terrain that the camera is above: of those whose root quad it is over, the first one whose
/// ground was measured, or else the first one; the first of all when it is over none; null when
/// there is none. As of their last update.
TerrainNode* terrainBelowCamera(const std::vector<TerrainNode*>& terrains);

/// The view controller for the shape of the first terrain, with its start view: straight down from
/// d = size (flat), 6 radii (planet) or 0.9 radii (cylinder) (terrain reference 5.1). Without a
/// terrain, a flat one as far away as the scene is large.
std::unique_ptr<TerrainViewController> makeViewController(const SceneNode& root);

/// What the view controller depends on: the first terrain's shape, and its radius in metres.
struct ViewShape {
    Deformation::Shape shape = Deformation::Shape::flat;
    double radius = 0;
    bool operator==(const ViewShape&) const = default;
};
ViewShape viewShape(const SceneNode& root);

} // namespace terrane
