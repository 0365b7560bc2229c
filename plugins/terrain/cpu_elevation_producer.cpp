// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/cpu_elevation_producer.h"

#include "producer/cpu_tile_storage.h"

#include <algorithm>

namespace terrane {

CpuElevationProducer::CpuElevationProducer(std::string name, std::shared_ptr<TileCache> cache,
                                           std::shared_ptr<TileProducer> residuals)
    : TileProducer(std::move(name), Task::Kind::cpu, "CreateCPUElevationTile", std::move(cache))
    , width_(this->cache().storage().tileSize())
    , residuals_(std::move(residuals), width_) {}

void CpuElevationProducer::setRootQuadSize(float size) {
    TileProducer::setRootQuadSize(size);
    residuals_.setRootQuadSize(size);
}

bool CpuElevationProducer::prefetchTile(const TileId& tile) {
    if (TileProducer::prefetchTile(tile)) return true;
    residuals_.prefetch(tile);
    return false;
}

bool CpuElevationProducer::startCreateTile(const TileId& tile, TileInputs& inputs) {
    if (tile.level > 0 && !inputs.need(*this, tile.parent())) return false;
    return residuals_.need(tile, inputs) && TileProducer::startCreateTile(tile, inputs);
}

bool CpuElevationProducer::doCreateTile(const TileId& tile, TileSlot& slot,
                                        const TileInputs& inputs) {
    const auto width = static_cast<std::size_t>(width_);
    const ElevationView<float> out{slot.as<CpuFloatTileStorage::Slot>().data(), width};
    if (residuals_.has(tile))
        residuals_.copy(tile, inputs, out);
    else
        std::fill_n(out.values, width * width, 0.0f);
    if (tile.level == 0) return true;
    const int half = (width_ - ResidualFile::kRest) / 2;
    const auto& parent = inputs.get(*this, tile.parent()).slot().as<CpuFloatTileStorage::Slot>();
    const ElevationView<const float> whole{parent.data(), width};
    addUpsampled(whole.at(tile.tx % 2 * half, tile.ty % 2 * half), out, width_);
    return true;
}

} // namespace terrane
