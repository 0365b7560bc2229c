// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/terrain_node.h"

#include <vector>

namespace terrane::bench {

/// The terrain of archives/mountains, without tiles.
TerrainNode mountainTerrain();

/// Views of 1024 x 768 pixels along a circle of 4 km, 900 m high, in steps of 60 m a frame: 3.6 km
/// a second at 60 frames a second.
std::vector<TerrainView> flight();

} // namespace terrane::bench
