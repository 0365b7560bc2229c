// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plugins/terrain/residual_file.h"
#include "plugins/terrain/residual_source.h"
#include "producer/tile_producer.h"

#include <memory>
#include <string>

namespace terrane {

/// Elevations of a terrain in main memory: the parent's, upsampled, plus residuals, on worker
/// threads; no noise, no layers (terrain reference 1.7). Tiles are (n+5)^2 values, as those of
/// elevationProducer.
class CpuElevationProducer final : public TileProducer {
public:
    /// @param cache of a CpuFloatTileStorage with one channel, tileSize n + 5
    /// @param residuals see ResidualSource
    CpuElevationProducer(std::string name, std::shared_ptr<TileCache> cache,
                         std::shared_ptr<TileProducer> residuals);

    int border() const override { return ResidualFile::kBorder; }
    void setRootQuadSize(float size) override;
    bool prefetchTile(const TileId& tile) override;

    bool startCreateTile(const TileId& tile, TileInputs& inputs) override;
    bool doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs& inputs) override;

private:
    const int width_; ///< of tiles, n + 5
    const ResidualSource residuals_;
};

} // namespace terrane
