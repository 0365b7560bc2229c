// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/residual_producer.h"

#include "producer/cpu_tile_storage.h"

namespace terrane {

std::optional<int> ResidualProducer::elevationTileSize() const {
    const ResidualFile* const file = pyramid_->file();
    if (!file || file->header().rootLevel > 0) return std::nullopt;
    return file->tileWidth(pyramid_->delta());
}

bool ResidualProducer::doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs&) {
    pyramid_->read(tile, slot.as<CpuFloatTileStorage::Slot>().data(), cache().storage().tileSize());
    return true;
}

} // namespace terrane
