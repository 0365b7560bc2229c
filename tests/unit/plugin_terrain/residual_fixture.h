// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plugin_terrain/terrain_fixture.h"
#include "producer/cpu_tile_storage.h"

#include <cmath>
#include <string>
#include <vector>

namespace terrane::test {

inline std::string cpuCache(const std::string& name, int tileSize, int capacity = 60) {
    return "<tileCache name=\"" + name +
           "\" scheduler=\"scheduler\"><cpuFloatTileStorage tileSize=\"" +
           std::to_string(tileSize) + "\" channels=\"1\" capacity=\"" + std::to_string(capacity) +
           "\"/></tileCache>\n";
}

inline std::string floatCache(const std::string& name, int tileSize, int capacity = 60) {
    return "<tileCache name=\"" + name + "\" scheduler=\"scheduler\"><gpuTileStorage tileSize=\"" +
           std::to_string(tileSize) + "\" nTiles=\"" + std::to_string(capacity) +
           "\" internalformat=\"RGB32F\" format=\"RGB\" type=\"FLOAT\"/></tileCache>\n";
}

/// The values of a tile in main memory.
inline std::vector<float> values(const Tile& tile) {
    const auto& slot = tile.slot().as<CpuFloatTileStorage::Slot>();
    return {slot.data(), slot.data() + slot.capacity()};
}

/// The larger of a millimetre and four steps of a float.
inline double elevationTolerance(double elevation) {
    const double step = std::ldexp(1.0, std::ilogb(std::max(std::abs(elevation), 1e-30)) - 23);
    return std::max(1e-3, 4 * step);
}

} // namespace terrane::test
