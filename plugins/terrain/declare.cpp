// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/declare.h"

#include "producer/tile_producer.h"
#include "resource/registry.h"

namespace terrane {

void declareTerrainPlugin(Registry& registry) {
    declareResidualProducer(registry);
    declareElevationProducer(registry);
    declareCpuElevationProducer(registry);
    declareNormalProducer(registry);

    registry.planned<TileProducer>("orthoCpuProducer", "Colour tiles from a file.");
    registry.planned<TileProducer>("orthoGpuProducer",
                                   "Colour tiles on the GPU, from the CPU and from layers.");
    registry.planned<TileProducer>("orthoProducer",
                                   "Colour tiles from residuals and noise, by upsampling.");
    registry.planned<TileLayer>("emptyOrthoLayer", "Fills colour tiles with one colour.");
    registry.planned<TileLayer>("textureLayer", "Draws tiles of one producer into another's.");
}

} // namespace terrane
