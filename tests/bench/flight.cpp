// SPDX-License-Identifier: BSD-3-Clause
#include "flight.h"

#include "ui/view_controller.h"

#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

namespace terrane::bench {

TerrainNode mountainTerrain() {
    return TerrainNode(
        {.size = 50000, .zmin = -200, .zmax = 5000, .splitFactor = 2, .maxLevel = 13});
}

std::vector<TerrainView> flight() {
    constexpr double kRadius = 4000, kStep = 60; // metres
    const int count = static_cast<int>(2 * glm::pi<double>() * kRadius / kStep);
    TerrainViewController controller;
    std::vector<TerrainView> views;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * glm::pi<double>() * i / count;
        controller.view = {.x0 = kRadius * std::cos(angle),
                           .y0 = kRadius * std::sin(angle),
                           .theta = 1.2,
                           .phi = angle,
                           .d = 900 / std::cos(1.2)};
        views.push_back({.localToCamera = glm::inverse(controller.cameraToWorld()),
                         .cameraToScreen = controller.cameraToScreen(1024, 768),
                         .viewportWidth = 1024});
    }
    return views;
}

} // namespace terrane::bench
