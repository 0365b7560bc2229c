// SPDX-License-Identifier: BSD-3-Clause
#include "mountains.h"

#include "app/register_types.h"
#include "core/files.h"
#include "plugins/standard_plugins.h"
#include "resource/registry.h"

namespace terrane::bench {

std::unique_ptr<Player> loadMountains() {
    static const std::unique_ptr<const Registry> registry = [] {
        auto made = std::make_unique<Registry>();
        registerStandardTypes(*made);
        registerStandardPlugins(*made);
        return made;
    }();
    auto player = std::make_unique<Player>(
        *registry, PlayerOptions{.archive = homeFolder() / "archives/mountains"});
    return player->load() ? std::move(player) : nullptr;
}

} // namespace terrane::bench
