// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/registry.h"

namespace terrane {

/// Declares `terrainNode`, which builds a TerrainNode (terrain reference 1.4).
void declareTerrainNode(Registry& registry);

} // namespace terrane
