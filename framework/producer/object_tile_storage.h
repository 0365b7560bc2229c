// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/tile_storage.h"

#include <memory>

namespace terrane {

/// Tiles that are any object: graphs, meshes, lists of plants. The producer puts the object of a
/// tile into its slot; the next one that gets the slot replaces it.
class ObjectTileStorage : public TileStorage {
public:
    class Slot : public TileSlot {
    public:
        using TileSlot::TileSlot;
        std::shared_ptr<void> object;

        /// The object, which must be a T.
        template <class T>
        T* get() const {
            return static_cast<T*>(object.get());
        }
    };

    explicit ObjectTileStorage(int capacity)
        : TileStorage(0) {
        std::vector<std::unique_ptr<TileSlot>> slots;
        for (int i = 0; i < capacity; ++i)
            slots.push_back(std::make_unique<Slot>(i));
        setSlots(std::move(slots));
    }
};

} // namespace terrane
