// SPDX-License-Identifier: BSD-3-Clause
#include "app/player_input.h"

#include "app/player.h"
#include "scene/scene_manager.h"
#include "ui/view_handler.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace terrane {

namespace {

constexpr const char* kLight = "light"; ///< the flag of the node that shines

/// Moves a node around the origin of its parent.
void turnAround(SceneNode& node, double azimuth, double elevation) {
    const glm::dvec3 position(node.localToParent[3]);
    const double distance = glm::length(position);
    if (distance == 0) return;
    const double around = std::atan2(position.y, position.x) + azimuth;
    // Straight above, there would be no azimuth to keep.
    constexpr double kSteepest = glm::half_pi<double>() - 1e-6;
    const double up = std::asin(std::clamp(position.z / distance, -1.0, 1.0)) + elevation;
    const double steep = std::clamp(up, -kSteepest, kSteepest);
    const glm::dvec3 direction(std::cos(steep) * std::cos(around),
                               std::cos(steep) * std::sin(around), std::sin(steep));
    node.localToParent[3] = glm::dvec4(distance * direction, 1);
}

ViewHandler::Surroundings surroundingsOf(Player& player) {
    return {[&player](double x, double y) { return player.groundAt(x, y); },
            [&player](double azimuth, double elevation) {
                const auto& lights = player.scene()->nodes(kLight);
                if (!lights.empty()) turnAround(*lights.front(), azimuth, elevation);
            }};
}

} // namespace

PlayerInput::PlayerInput() = default;

PlayerInput::~PlayerInput() = default;

// A reload may bring another view controller.
ViewHandler* PlayerInput::viewHandler(Player& player) {
    TerrainViewController* const controller = player.drawable() ? &player.controller() : nullptr;
    if (controller == controller_) return view_.get();
    controller_ = controller;
    view_.reset();
    if (controller_) view_ = std::make_unique<ViewHandler>(*controller_, surroundingsOf(player));
    return view_.get();
}

bool PlayerInput::handle(Player& player, const InputEvent& event) {
    ViewHandler* const view = viewHandler(player);
    return view && view->handle(event);
}

void PlayerInput::advance(Player& player, double seconds) {
    if (ViewHandler* const view = viewHandler(player)) view->advance(seconds);
}

bool presses(const InputEvent& event, Key key) {
    const auto* pressed = std::get_if<KeyEvent>(&event);
    return pressed && pressed->down && pressed->key == key;
}

} // namespace terrane
