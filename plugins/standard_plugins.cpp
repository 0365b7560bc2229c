// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/standard_plugins.h"

#include "plugins/planned_plugins.h"
#include "plugins/terrain/declare.h"
#include "resource/registry.h"

namespace terrane {

void registerStandardPlugins(Registry& registry) {
    declarePlannedPlugins(registry); // first: what is built replaces it
    registry.chapter("Producers of terrain", "What makes the tiles of a terrain: elevations from "
                                             "files and noise, and normals from elevations.");
    declareTerrainPlugin(registry);
}

} // namespace terrane
