// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/reload_report.h"
#include "core/file_watcher.h"

#include <optional>

namespace terrane {

class Player;

/// Watches the files of a player's archive, and has it reload when they change. Costs nothing as
/// long as they don't. Used on the player's thread.
class EditFollower {
public:
    /// The player must outlive it, and load() or reload() must have been called.
    explicit EditFollower(Player& player);

    /// To be called between two frames; what came of it if files have changed.
    std::optional<ReloadReport> follow();
    /// Reloads at once.
    ReloadReport reload();

private:
    Player& player_;
    FileWatcher watcher_;
};

} // namespace terrane
