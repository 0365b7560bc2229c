// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/input_event.h"

#include <bitset>
#include <functional>
#include <glm/glm.hpp>
#include <optional>

namespace terrane {

class TerrainViewController;

/// Moves a view with mouse and keys, as the original's basicViewHandler does (terrain reference
/// 5.2):
///
///     left button and drag            the ground follows the pointer
///     control, any button and drag    turns around the point looked at
///     middle or right button and drag moves the light
///     wheel, page up and down         farther and nearer
///     up and down                     forwards and back, in a second as far as one is high
///     left and right                  turns on the spot
///
/// Feed it events as they come, and advance it once before each frame. Knows no window: a script or
/// a test can feed it as well. Not thread-safe.
class ViewHandler {
public:
    /// What a pointer points at, and what else than the view it moves. Either may be empty.
    struct Surroundings {
        /// The point of the ground that the last picture shows at a place, in the world; none
        /// where it shows no ground. Asked at most twice a frame.
        std::function<std::optional<glm::dvec3>(double x, double y)> groundAt;
        /// Moves the light around what it shines at, radians: `azimuth` counter-clockwise seen from
        /// above, `elevation` upwards.
        std::function<void(double azimuth, double elevation)> turnLight;
    };

    ViewHandler(TerrainViewController& controller, Surroundings surroundings)
        : controller_(controller)
        , surroundings_(std::move(surroundings)) {}

    /// False when the event means nothing to it.
    bool handle(const InputEvent& event);
    /// What was dragged and what keys are held for `seconds` since the last frame take effect.
    void advance(double seconds);

private:
    enum class Drag { none, move, turn, light };
    enum HeldKey { pageUp, pageDown, up, down, left, right, kHeldKeys };

    bool take(const KeyEvent& event);
    bool take(const TextEvent&) { return false; }
    bool take(const MouseButtonEvent& event);
    bool take(const MouseMoveEvent& event);
    bool take(const WheelEvent& event);
    void drag();
    void scaleDistance(double factor);
    double held(HeldKey more, HeldKey less) const { return held_[more] - double(held_[less]); }

    TerrainViewController& controller_;
    const Surroundings surroundings_;
    Drag drag_ = Drag::none;
    MouseButton button_{};  ///< that drags
    glm::dvec2 from_{0};    ///< where the last frame left the pointer
    glm::dvec2 pointer_{0}; ///< where it is now
    std::bitset<kHeldKeys> held_;
};

} // namespace terrane
