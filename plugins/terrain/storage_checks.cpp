// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/storage_checks.h"

#include <algorithm>

namespace terrane {

namespace {

template <class S>
const S* storageAs(const TileCache& cache, const Place& reference, const std::string& right,
                   Diagnostics& diagnostics) {
    const auto* const storage = dynamic_cast<const S*>(&cache.storage());
    if (!storage)
        diagnostics.error("wrong-storage", reference,
                          "the storage of cache '" + cache.name() + "' is of the wrong kind",
                          "a cache with a " + right);
    return storage;
}

} // namespace

const GpuTileStorage* gpuStorage(const Ref<TileCache>& cache, Diagnostics& diagnostics) {
    return storageAs<GpuTileStorage>(*cache, cache.place, "gpuTileStorage", diagnostics);
}

const CpuFloatTileStorage* cpuFloatStorage(const TileCache& cache, const Place& reference,
                                           Diagnostics& diagnostics) {
    return storageAs<CpuFloatTileStorage>(cache, reference, "cpuFloatTileStorage", diagnostics);
}

void reportTileSize(const TileStorage& storage, const Place& reference, const std::string& who,
                    const std::string& right, Diagnostics& diagnostics) {
    const Place& place = storage.tileSizePlace() ? storage.tileSizePlace() : reference;
    diagnostics.error("wrong-tile-size", place,
                      std::to_string(storage.tileSize()) + " is the wrong tile size for " + who,
                      right);
}

void reportFormat(const TileStorage& storage, const Place& reference, const std::string& found,
                  const std::string& right, Diagnostics& diagnostics) {
    const Place& place = storage.formatPlace() ? storage.formatPlace() : reference;
    diagnostics.error("wrong-format", place, found, right);
}

std::string multiplesNear(int step, int rest, int size) {
    const int k = std::max(1, (size - rest + step / 2) / step);
    return std::to_string(step) + "k+" + std::to_string(rest) + ", such as " +
           std::to_string(k * step + rest);
}

} // namespace terrane
