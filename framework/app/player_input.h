// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/input_event.h"

#include <memory>

namespace terrane {

class Player;
class TerrainViewController;
class ViewHandler;

/// What mouse and keys do to a player, wherever they come from: a window, or a script.
class PlayerInput {
public:
    PlayerInput();
    ~PlayerInput();
    PlayerInput(const PlayerInput&) = delete;
    PlayerInput& operator=(const PlayerInput&) = delete;

    /// False when the event means nothing here; so it is where there is nothing to draw.
    bool handle(Player& player, const InputEvent& event);
    /// Before a frame: what was dragged, and keys that are held, take effect for so many seconds.
    void advance(Player& player, double seconds);

private:
    ViewHandler* viewHandler(Player& player);

    std::unique_ptr<ViewHandler> view_;
    TerrainViewController* controller_ = nullptr; ///< that the handler moves
};

/// Whether a key comes down.
bool presses(const InputEvent& event, Key key);

} // namespace terrane
