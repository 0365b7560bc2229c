// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plugins/terrain/residual_pyramid.h"
#include "producer/tile_producer.h"

#include <memory>
#include <optional>
#include <string>

namespace terrane {

/// Residuals of a terrain from a file, decoded on worker threads: the root tile holds elevations,
/// the others what is to be added to the upsampled elevations of the level above (terrain reference
/// 1.7). Tiles are arrays of (n+5)^2 values, of which those of the first levels fill only the lower
/// left part: the root has (n / 2^(minLevel - delta) + 5)^2.
class ResidualProducer final : public TileProducer {
public:
    /// @param cache of a CpuFloatTileStorage with one channel; tileSize n + 5 if there is a file
    ResidualProducer(std::string name, std::shared_ptr<TileCache> cache,
                     std::unique_ptr<ResidualPyramid> pyramid)
        : TileProducer(std::move(name), Task::Kind::cpu, "CreateResidualTile", std::move(cache))
        , pyramid_(std::move(pyramid)) {}

    const ResidualPyramid& pyramid() const { return *pyramid_; }

    /// Tile size of elevations whose root tile is the root of these residuals; nothing when any
    /// would do, as of residuals without a file.
    std::optional<int> elevationTileSize() const;

    int border() const override { return ResidualFile::kBorder; }
    bool hasTile(const TileId& tile) const override { return pyramid_->hasTile(tile); }
    bool doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs& inputs) override;

private:
    const std::unique_ptr<ResidualPyramid> pyramid_;
};

} // namespace terrane
