// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "producer/cpu_tile_storage.h"
#include "producer/gpu_tile_storage.h"
#include "producer/tile_cache.h"
#include "resource/value.h"

#include <string>

namespace terrane {

// What producers ask of the storages of caches, told at load time where the archive says it.

/// The storage of a cache if it is one on the GPU; else null, with a diagnostic ("wrong-storage").
const GpuTileStorage* gpuStorage(const Ref<TileCache>& cache, Diagnostics& diagnostics);
/// The same for floats on the CPU. `reference` is what led to the cache.
const CpuFloatTileStorage* cpuFloatStorage(const TileCache& cache, const Place& reference,
                                           Diagnostics& diagnostics);

/// Reports "wrong-tile-size" at the storage's attribute, or at `reference` if it has no place.
/// @param right the sizes that would do: "24k+5, such as 101"
void reportTileSize(const TileStorage& storage, const Place& reference, const std::string& who,
                    const std::string& right, Diagnostics& diagnostics);
/// Reports "wrong-format" in the same way.
void reportFormat(const TileStorage& storage, const Place& reference, const std::string& found,
                  const std::string& right, Diagnostics& diagnostics);

/// Whether residuals are on the CPU, of one channel, with the border of elevations, and a tile of
/// them covers whole tiles of elevations; of a file, just those that its delta asks for. Reports
/// "wrong-storage", "wrong-producer" or "wrong-tile-size".
/// @param elevations storage of the elevations; `cache` is what led to it
bool checkResiduals(const TileStorage& elevations, const Place& cache,
                    const TileProducer& residuals, const Place& reference,
                    Diagnostics& diagnostics);

/// "24k+1, such as 97": the multiples of `step` (at least one) plus `rest`, and the nearest to
/// `size`.
std::string multiplesNear(int step, int rest, int size);

} // namespace terrane
