// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/player.h"

#include <memory>

namespace terrane::bench {

/// archives/mountains, loaded; null when it can't be.
std::unique_ptr<Player> loadMountains();

} // namespace terrane::bench
