// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/options.h"
#include "app/player_input.h"
#include "core/input_event.h"
#include "render/window.h"

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace terrane {

class Player;

/// The window of a player: shows its frames, and hands what a person does in it to the player's
/// view. Escape closes it. On the program's main thread only.
///
///     PlayerWindow window("mountains");
///     window.install(options);
///     Player player(registry, options);
///     if (player.load()) while (window.prepare(player) && player.frame()) window.show(player);
class PlayerWindow {
public:
    /// @param name what is played, for the title
    explicit PlayerWindow(std::string name);
    ~PlayerWindow();
    PlayerWindow(const PlayerWindow&) = delete;
    PlayerWindow& operator=(const PlayerWindow&) = delete;

    /// The player made with these options will draw in this window, of their size. The window is
    /// opened when the archive has been read, and belongs to the player.
    void install(PlayerOptions& options);

    /// Before a frame: follows the window's size, moves the view as the person asks to. Waits as
    /// long as the window is minimised. False when it is to be closed.
    bool prepare(Player& player);
    /// The same without moving the view, for frames of a script.
    bool follow(Player& player);
    /// After a frame: presents it.
    void show(const Player& player);
    /// Sleeps until something happens in it, at most so many seconds.
    void wait(Player& player, double seconds);
    bool closing() const;
    /// There is one: the display and OpenGL could be had.
    bool isOpen() const { return window_ != nullptr; }
    /// Whether F5 was pressed since the last call.
    bool takeReload() { return std::exchange(reload_, false); }

private:
    using Clock = std::chrono::steady_clock;

    void handle(Player& player, const std::vector<InputEvent>& events);

    const std::string name_;
    Window* window_ = nullptr; ///< the player's
    PlayerInput input_;
    Clock::time_point last_{};
    bool reload_ = false;
};

} // namespace terrane
