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

// Terrain reference 3.5, with (x,y) the centre of the tile and r its R.
TileLayer::Deformation TileLayer::deformation(const TileId& tile) const {
    const TileCoordinates quad = tileCoordinates(tile);
    const double r = producer_->rootQuadSize() / 2;
    const double x = quad.ox + quad.size / 2;
    const double y = quad.oy + quad.size / 2;
    const double xx = x * x, yy = y * y, rr = r * r;
    const double d = r * std::sqrt(xx + yy + rr);
    const double e = r / (std::sqrt(yy + rr) * (xx + yy + rr));
    return {.nx = {x * y / d, (yy + rr) / d},
            .ny = {-(xx + rr) / d, -x * y / d},
            .lx = {e * (yy + rr), 0},
            .ly = {-e * x * y, e * d}};
}

} // namespace terrane
