// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// <updateTerrain>, <updateTileSamplers> (alias <updateUniform>) and <drawTerrain> (terrain
/// reference 1.6, 3.8).
void declareTerrainTasks(Registry& registry);

} // namespace terrane
