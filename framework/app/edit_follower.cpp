// SPDX-License-Identifier: BSD-3-Clause
#include "app/edit_follower.h"

#include "app/player.h"

namespace terrane {

EditFollower::EditFollower(Player& player)
    : player_(player) {
    watcher_.watch(player_.sourceFolders());
}

std::optional<ReloadReport> EditFollower::follow() {
    if (!watcher_.takeChange()) return std::nullopt;
    return reload();
}

ReloadReport EditFollower::reload() {
    ReloadReport report = player_.reload();
    watcher_.watch(player_.sourceFolders()); // an edit may name files of other folders
    return report;
}

} // namespace terrane
