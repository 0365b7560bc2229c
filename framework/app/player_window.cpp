// SPDX-License-Identifier: BSD-3-Clause
#include "app/player_window.h"

#include "app/player.h"
#include "render/render_target.h"
#include "scene/scene_manager.h"
#include "ui/view_handler.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

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

bool presses(const InputEvent& event, Key wanted) {
    const auto* key = std::get_if<KeyEvent>(&event);
    return key && key->down && key->key == wanted;
}

} // namespace

PlayerWindow::PlayerWindow(std::string name)
    : name_(std::move(name)) {}

PlayerWindow::~PlayerWindow() = default;

void PlayerWindow::install(PlayerOptions& options) {
    const Window::Options shape{options.width, options.height, name_ + " - Terrane"};
    options.makeContext = [this,
                           shape](Diagnostics& diagnostics,
                                  const GlContext::Options& wanted) -> std::unique_ptr<GlContext> {
        auto window = Window::open(shape, diagnostics, wanted);
        window_ = window.get();
        return window;
    };
}

bool PlayerWindow::prepare(Player& player) {
    if (!player.drawable()) {
        view_.reset();
        controller_ = nullptr;
        return follow(player);
    }
    if (!view_ || controller_ != &player.controller()) {
        controller_ = &player.controller(); // a reload may bring another one
        view_ = std::make_unique<ViewHandler>(*controller_, surroundingsOf(player));
    }
    if (!follow(player)) return false;
    const Clock::time_point now = Clock::now();
    const double elapsed =
        player.frames() == 0 ? 0 : std::chrono::duration<double>(now - last_).count();
    last_ = now;
    view_->advance(elapsed);
    return true;
}

bool PlayerWindow::follow(Player& player) {
    handle(window_->poll());
    while (!window_->closing() && window_->width() * window_->height() == 0)
        handle(window_->wait());
    if (window_->closing()) return false;
    player.resize(window_->width(), window_->height());
    return true;
}

void PlayerWindow::handle(const std::vector<InputEvent>& events) {
    for (const InputEvent& event : events) {
        if (presses(event, Key::escape))
            window_->close();
        else if (presses(event, Key::f5))
            reload_ = true;
        else if (view_)
            view_->handle(event);
    }
}

void PlayerWindow::show(const Player& player) {
    const RenderTarget& picture = player.picture();
    window_->present(picture.framebuffer(), picture.width(), picture.height());
}

void PlayerWindow::wait(double seconds) {
    handle(window_->wait(seconds));
}

bool PlayerWindow::closing() const {
    return window_ && window_->closing();
}

} // namespace terrane
