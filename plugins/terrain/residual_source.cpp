// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/residual_source.h"

#include "plugins/terrain/residual_file.h"
#include "producer/cpu_tile_storage.h"

#include <algorithm>
#include <cassert>

namespace terrane {

namespace {

int tilesAlongEdge(const TileProducer* residuals, int width) {
    if (!residuals) return 1;
    const int n = width - ResidualFile::kRest;
    const int residualN = residuals->cache().storage().tileSize() - ResidualFile::kRest;
    assert(residuals->border() == ResidualFile::kBorder && residualN % n == 0 &&
           "ResidualSource: tile size");
    return residualN / n;
}

} // namespace

ResidualSource::ResidualSource(std::shared_ptr<TileProducer> residuals, int width)
    : residuals_(std::move(residuals))
    , width_(width)
    , tiles_(tilesAlongEdge(residuals_.get(), width)) {}

bool ResidualSource::has(const TileId& tile) const {
    return residuals_ && residuals_->hasTile(residualTile(tile));
}

bool ResidualSource::need(const TileId& tile, TileInputs& inputs) const {
    return !has(tile) || inputs.need(*residuals_, residualTile(tile));
}

void ResidualSource::copy(const TileId& tile, const TileInputs& inputs,
                          ElevationView<float> out) const {
    const auto& slot =
        inputs.get(*residuals_, residualTile(tile)).slot().as<CpuFloatTileStorage::Slot>();
    const auto stride = static_cast<std::size_t>(residuals_->cache().storage().tileSize());
    const int n = width_ - ResidualFile::kRest;
    const ElevationView<const float> part = ElevationView<const float>{slot.data(), stride}.at(
        tile.tx % tiles_ * n, tile.ty % tiles_ * n);
    for (int y = 0; y < width_; ++y)
        std::copy_n(part.row(y), width_, out.row(y));
}

void ResidualSource::prefetch(const TileId& tile) const {
    if (has(tile)) residuals_->prefetchTile(residualTile(tile));
}

void ResidualSource::setRootQuadSize(float size) const {
    if (residuals_) residuals_->setRootQuadSize(size);
}

} // namespace terrane
