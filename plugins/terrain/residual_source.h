// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plugins/terrain/upsample.h"
#include "producer/tile_producer.h"

#include <memory>

namespace terrane {

/// Where elevations get their residuals: a tile of residuals covers a square of elevation tiles of
/// the same level (terrain reference 2.4, "m").
class ResidualSource {
public:
    /// @param residuals floats on the CPU, one channel, border 2, tileSize m n + 5; or null
    /// @param width of elevation tiles, n + 5
    ResidualSource(std::shared_ptr<TileProducer> residuals, int width);

    bool has(const TileId& tile) const;
    /// To be called in startCreateTile.
    bool need(const TileId& tile, TileInputs& inputs) const;
    /// Copies the part of an elevation tile that there is.
    void copy(const TileId& tile, const TileInputs& inputs, ElevationView<float> out) const;

    void prefetch(const TileId& tile) const;
    void setRootQuadSize(float size) const;

private:
    TileId residualTile(const TileId& tile) const {
        return {tile.level, tile.tx / tiles_, tile.ty / tiles_};
    }

    const std::shared_ptr<TileProducer> residuals_;
    const int width_;
    const int tiles_; ///< elevation tiles along the edge of a residual tile
};

} // namespace terrane
