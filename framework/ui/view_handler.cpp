// SPDX-License-Identifier: BSD-3-Clause
#include "ui/view_handler.h"

#include "ui/view_controller.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace terrane {

namespace {

// Terrain reference 5.2.
constexpr double kWheelFactor = 1.2; // of the distance, a step
constexpr double kPageFactor = 1.02; // of the distance, kPageSteps times a second
constexpr double kPageSteps = 50;
constexpr double kTurnSpeed = 0.5;     // radians a second
constexpr double kTurnPixels = 500;    // of a drag, a radian
constexpr double kLightDegrees = 0.25; // a pixel

// So that however long somebody turns the wheel, there is a way back.
constexpr double kLeastDistance = 1e-3, kMostDistance = 1e12; // metres

} // namespace

bool ViewHandler::handle(const InputEvent& event) {
    return std::visit([this](const auto& e) { return take(e); }, event);
}

bool ViewHandler::take(const KeyEvent& event) {
    static constexpr std::pair<Key, HeldKey> kKeys[] = {
        {Key::pageUp, pageUp}, {Key::pageDown, pageDown}, {Key::up, up},
        {Key::down, down},     {Key::left, left},         {Key::right, right}};
    for (const auto& [key, index] : kKeys) {
        if (key != event.key) continue;
        held_[index] = event.down;
        return true;
    }
    return false;
}

bool ViewHandler::take(const MouseButtonEvent& event) {
    if (!event.down) {
        if (drag_ == Drag::none || event.button != button_) return false;
        pointer_ = {event.x, event.y};
        drag();
        drag_ = Drag::none;
        return true;
    }
    if (drag_ != Drag::none) return false; // one at a time
    const Modifiers& with = event.modifiers;
    if (with.control)
        drag_ = Drag::turn;
    else if (event.button != MouseButton::left)
        drag_ = Drag::light;
    else if (!with.shift && !with.alt)
        drag_ = Drag::move;
    button_ = event.button;
    from_ = pointer_ = {event.x, event.y};
    return drag_ != Drag::none;
}

bool ViewHandler::take(const MouseMoveEvent& event) {
    pointer_ = {event.x, event.y};
    return drag_ != Drag::none;
}

bool ViewHandler::take(const WheelEvent& event) {
    scaleDistance(std::pow(kWheelFactor, -event.steps));
    return true;
}

void ViewHandler::advance(double seconds) {
    drag();
    // A slow frame is one step only, as the original's.
    const double pages = held(pageUp, pageDown);
    if (pages != 0)
        scaleDistance(std::pow(kPageFactor, pages * std::min(kPageSteps * seconds, 1.0)));
    const double ahead = held(up, down);
    const double speed = std::max(controller_.height() - controller_.groundHeight, 0.0);
    if (ahead != 0) controller_.forward(ahead * speed * seconds);
    const double turn = held(left, right);
    if (turn != 0) controller_.turn(turn * kTurnSpeed * seconds);
}

void ViewHandler::drag() {
    const glm::dvec2 moved = pointer_ - from_;
    if (drag_ == Drag::none || moved == glm::dvec2(0)) return;
    if (drag_ == Drag::turn) {
        View& view = controller_.view;
        view.phi -= moved.x / kTurnPixels;
        view.theta =
            std::clamp(view.theta - moved.y / kTurnPixels, -glm::pi<double>(), glm::pi<double>());
    } else if (drag_ == Drag::light && surroundings_.turnLight) {
        const glm::dvec2 angles = glm::radians(kLightDegrees * moved);
        surroundings_.turnLight(angles.x, -angles.y);
    } else if (drag_ == Drag::move && surroundings_.groundAt) {
        const auto from = surroundings_.groundAt(from_.x, from_.y);
        const auto to = surroundings_.groundAt(pointer_.x, pointer_.y);
        if (from && to) controller_.move(*from, *to);
    }
    from_ = pointer_;
}

void ViewHandler::scaleDistance(double factor) {
    controller_.view.d = std::clamp(controller_.view.d * factor, kLeastDistance, kMostDistance);
}

} // namespace terrane
