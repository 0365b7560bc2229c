// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/source.h"
#include "resource/resource.h"

#include <cassert>
#include <memory>
#include <utility>
#include <vector>

namespace terrane {

/// A place that holds the data of one tile; each kind of storage derives its own. Lives as long as
/// its storage.
class TileSlot {
public:
    explicit TileSlot(int index)
        : index_(index) {}
    TileSlot(const TileSlot&) = delete;
    TileSlot& operator=(const TileSlot&) = delete;
    virtual ~TileSlot() = default;

    int index() const { return index_; } ///< from 0, in the storage
    bool allocated() const { return allocated_; }

    /// As the slot of a kind of storage that it must come from.
    template <class S>
    S& as() {
        assert(dynamic_cast<S*>(this) && "TileSlot::as: slot of another kind of storage");
        return static_cast<S&>(*this);
    }
    template <class S>
    const S& as() const {
        return const_cast<TileSlot*>(this)->as<S>();
    }

private:
    friend class TileStorage;
    const int index_;
    bool allocated_ = false;
};

/// A fixed number of slots for tiles, each free or allocated. Several caches may share one. Slots
/// are handed out on the GL thread; the data of an allocated slot belongs to the task that fills
/// it, on any thread, then to everybody who holds the tile.
class TileStorage : public Resource {
public:
    /// Edge of a tile in pixels, borders included; 0 for tiles that aren't rasters.
    int tileSize() const { return tileSize_; }
    int capacity() const { return static_cast<int>(slots_.size()); }
    int freeSlots() const { return freeCount_; }

    /// The free slot that has been free for longest, first in the order of their numbers. Null when
    /// there is none.
    TileSlot* newSlot();
    /// Back to the end of the free ones.
    void deleteSlot(TileSlot& slot);

    /// Where an archive says what the tiles are like, for messages about storages that a producer
    /// can't use.
    const Place& tileSizePlace() const { return tileSizePlace_; }
    const Place& formatPlace() const { return formatPlace_; }
    void setPlaces(Place tileSize, Place format) {
        tileSizePlace_ = std::move(tileSize);
        formatPlace_ = std::move(format);
    }

    TileSlot& slot(int index) const { return *slots_[static_cast<std::size_t>(index)]; }

protected:
    explicit TileStorage(int tileSize)
        : tileSize_(tileSize) {}
    /// To be called by constructors, with the slots in the order of their numbers.
    void setSlots(std::vector<std::unique_ptr<TileSlot>> slots);

private:
    const int tileSize_;
    Place tileSizePlace_, formatPlace_;
    std::vector<std::unique_ptr<TileSlot>> slots_;
    std::vector<TileSlot*> free_; // a ring
    int firstFree_ = 0;
    int freeCount_ = 0;
};

} // namespace terrane
