// SPDX-License-Identifier: BSD-3-Clause
#include "producer/tile_layer.h"

#include "producer/tile_producer.h"

#include <cassert>
#include <cmath>

namespace terrane {

void TileLayer::setEnabled(bool enabled) {
    if (enabled == enabled_) return;
    enabled_ = enabled;
    if (producer_) producer_->invalidateTiles();
}

TileCoordinates TileLayer::tileCoordinates(const TileId& tile) const {
    assert(producer_ && "TileLayer::tileCoordinates: no producer has adopted the layer");
    return terrane::tileCoordinates(tile, producer_->rootQuadSize());
}

// Terrain reference 3.5, with (x,y) the centre of the tile.
TileLayer::Deformation TileLayer::deformation(const TileId& tile) const {
    const TileCoordinates quad = tileCoordinates(tile);
    const double R = producer_->rootQuadSize() / 2;
    const double x = quad.ox + quad.size / 2;
    const double y = quad.oy + quad.size / 2;
    const double xx = x * x, yy = y * y, RR = R * R;
    const double d = R * std::sqrt(xx + yy + RR);
    const double e = R / (std::sqrt(yy + RR) * (xx + yy + RR));
    return {.nx = {x * y / d, (yy + RR) / d},
            .ny = {-(xx + RR) / d, -x * y / d},
            .lx = {e * (yy + RR), 0},
            .ly = {-e * x * y, e * d}};
}

} // namespace terrane
