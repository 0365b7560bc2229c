// SPDX-License-Identifier: BSD-3-Clause
#include "app/player_window.h"

#include "app/player.h"
#include "render/render_target.h"

#include <utility>

namespace terrane {

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
    if (!follow(player)) return false;
    const Clock::time_point now = Clock::now();
    const double elapsed =
        player.frames() == 0 ? 0 : std::chrono::duration<double>(now - last_).count();
    last_ = now;
    input_.advance(player, elapsed);
    return true;
}

bool PlayerWindow::follow(Player& player) {
    handle(player, window_->poll());
    while (!window_->closing() && window_->width() * window_->height() == 0)
        handle(player, window_->wait());
    if (window_->closing()) return false;
    player.resize(window_->width(), window_->height());
    return true;
}

void PlayerWindow::handle(Player& player, const std::vector<InputEvent>& events) {
    for (const InputEvent& event : events) {
        if (presses(event, Key::escape))
            window_->close();
        else if (presses(event, Key::f5))
            reload_ = true;
        else
            input_.handle(player, event);
    }
}

void PlayerWindow::show(const Player& player) {
    const RenderTarget& picture = player.picture();
    window_->present(picture.framebuffer(), picture.width(), picture.height());
}

void PlayerWindow::wait(Player& player, double seconds) {
    handle(player, window_->wait(seconds));
}

bool PlayerWindow::closing() const {
    return window_ && window_->closing();
}

} // namespace terrane
