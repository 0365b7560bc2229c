// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/storage_checks.h"

#include "plugins/terrain/residual_producer.h"

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

// "101; for delta 0, 1, 2: 29, 53, 101"
std::string sizesForDeltas(const ResidualPyramid& residuals) {
    const ResidualFile& file = *residuals.file();
    std::string deltas, sizes;
    for (int delta = 0; delta <= file.largestDelta(); ++delta) {
        const char* const comma = delta > 0 ? ", " : "";
        deltas += comma + std::to_string(delta);
        sizes += comma + std::to_string(file.tileWidth(delta));
    }
    const int right = file.tileWidth(residuals.delta());
    return std::to_string(right) + (deltas == "0" ? "" : "; for delta " + deltas + ": " + sizes);
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

bool checkResiduals(const TileStorage& elevations, const Place& cache,
                    const TileProducer& residuals, const Place& reference,
                    Diagnostics& diagnostics) {
    const auto* const storage = cpuFloatStorage(residuals.cache(), reference, diagnostics);
    if (!storage) return false;
    if (residuals.border() != ResidualFile::kBorder || storage->channels() != 1) {
        diagnostics.error("wrong-producer", reference,
                          "'" + residuals.name() + "' does not produce residuals",
                          "a producer of one channel with a border of 2");
        return false;
    }
    const int size = elevations.tileSize();
    if (const auto* const producer = dynamic_cast<const ResidualProducer*>(&residuals)) {
        const auto right = producer->elevationTileSize();
        if (right == size) return true;
        if (right) {
            const ResidualPyramid& pyramid = producer->pyramid();
            reportTileSize(elevations, cache,
                           "elevations with the residuals '" + residuals.name() + "' and delta " +
                               std::to_string(pyramid.delta()),
                           sizesForDeltas(pyramid), diagnostics);
            return false;
        }
    }
    const int n = size - ResidualFile::kRest;
    const int residualN = storage->tileSize() - ResidualFile::kRest;
    if (n <= 0) return true; // of no use for elevations at all, which is told elsewhere
    if (residualN > 0 && residualN % n == 0) return true;
    reportTileSize(*storage, reference, "residuals of elevation tiles of " + std::to_string(size),
                   multiplesNear(n, ResidualFile::kRest, storage->tileSize()), diagnostics);
    return false;
}

std::string multiplesNear(int step, int rest, int size) {
    const int k = std::max(1, (size - rest + step / 2) / step);
    return std::to_string(step) + "k+" + std::to_string(rest) + ", such as " +
           std::to_string(k * step + rest);
}

} // namespace terrane
