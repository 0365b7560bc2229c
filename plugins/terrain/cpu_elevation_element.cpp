// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/cpu_elevation_producer.h"
#include "plugins/terrain/declare.h"
#include "plugins/terrain/residual_file.h"
#include "plugins/terrain/storage_checks.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"

namespace terrane {

namespace {

struct CpuElevationDescription : ElementDescription {
    Ref<TileCache> cache;
    Ref<TileProducer> residuals;
};

bool checkStorage(const CpuElevationDescription& d, const CpuFloatTileStorage& storage,
                  Diagnostics& diagnostics) {
    if (storage.channels() != 1) {
        reportFormat(storage, d.cache.place,
                     "elevations can't be stored in " + std::to_string(storage.channels()) +
                         " channels",
                     "1 channel", diagnostics);
        return false;
    }
    if (!checkResiduals(storage, d.cache.place, *d.residuals, d.residuals.place, diagnostics))
        return false;
    // A tile is two parent halves wide.
    const int n = storage.tileSize() - ResidualFile::kRest;
    if (n > 0 && n % 2 == 0) return true;
    reportTileSize(storage, d.cache.place, "elevations",
                   multiplesNear(2, ResidualFile::kRest, storage.tileSize()), diagnostics);
    return false;
}

std::shared_ptr<CpuElevationProducer> buildCpuElevations(const CpuElevationDescription& d,
                                                         BuildContext& context) {
    Diagnostics& diagnostics = context.diagnostics();
    const auto* const storage = cpuFloatStorage(*d.cache, d.cache.place, diagnostics);
    if (!storage || !checkStorage(d, *storage, diagnostics)) return nullptr;
    return makeProducer<CpuElevationProducer>(context.name(), d.cache.shared(),
                                              d.residuals.shared());
}

} // namespace

void declareCpuElevationProducer(Registry& registry) {
    using D = CpuElevationDescription;
    registry
        .resource<CpuElevationProducer, D, TileProducer>(
            "cpuElevationProducer",
            "Elevations in main memory: the parent's, upsampled, plus residuals.")
        .attribute("cache", &D::cache,
                   "where the tiles are; a cpuFloatTileStorage with one channel, tileSize that of "
                   "the residuals' root")
        .required()
        .attribute("residuals", &D::residuals, "producer of what is added to upsampled elevations")
        .required()
        .build(buildCpuElevations);
}

} // namespace terrane
