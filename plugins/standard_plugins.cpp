// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/standard_plugins.h"

#include "plugins/planned_plugins.h"
#include "plugins/terrain/declare.h"

namespace terrane {

void registerStandardPlugins(Registry& registry) {
    declarePlannedPlugins(registry); // first: what is built replaces it
    declareTerrainPlugin(registry);
}

} // namespace terrane
