// SPDX-License-Identifier: BSD-3-Clause
#include "producer/tile_storage.h"

namespace terrane {

void TileStorage::setSlots(std::vector<std::unique_ptr<TileSlot>> slots) {
    slots_ = std::move(slots);
    free_.clear();
    for (const auto& slot : slots_)
        free_.push_back(slot.get());
    firstFree_ = 0;
    freeCount_ = capacity();
}

TileSlot* TileStorage::newSlot() {
    if (freeCount_ == 0) return nullptr;
    TileSlot* const slot = free_[static_cast<std::size_t>(firstFree_)];
    firstFree_ = (firstFree_ + 1) % capacity();
    --freeCount_;
    slot->allocated_ = true;
    return slot;
}

void TileStorage::deleteSlot(TileSlot& slot) {
    assert(&slot == slots_[static_cast<std::size_t>(slot.index())].get() &&
           "TileStorage::deleteSlot: slot of another storage");
    assert(slot.allocated() && "TileStorage::deleteSlot: the slot is free");
    slot.allocated_ = false;
    free_[static_cast<std::size_t>((firstFree_ + freeCount_) % capacity())] = &slot;
    ++freeCount_;
}

} // namespace terrane
