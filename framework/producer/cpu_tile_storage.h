// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/tile_storage.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace terrane {

/// Raster tiles in memory: tileSize^2 pixels of `channels` values each, row by row from the bottom,
/// channels together (terrain reference 1.1).
template <class T>
class CpuTileStorage : public TileStorage {
public:
    class Slot : public TileSlot {
    public:
        Slot(int index, std::size_t count)
            : TileSlot(index)
            , size(count)
            , data_(count) {}

        T* data() { return data_.data(); }
        const T* data() const { return data_.data(); }
        std::size_t capacity() const { return data_.size(); }

        /// Values in use; less than the capacity for tiles that are kept compressed.
        std::size_t size;

    private:
        std::vector<T> data_;
    };

    /// @param tileSize edge in pixels, borders included
    CpuTileStorage(int tileSize, int channels, int capacity)
        : TileStorage(tileSize)
        , channels_(channels) {
        const auto edge = static_cast<std::size_t>(tileSize);
        std::vector<std::unique_ptr<TileSlot>> slots;
        for (int i = 0; i < capacity; ++i)
            slots.push_back(
                std::make_unique<Slot>(i, edge * edge * static_cast<std::size_t>(channels)));
        setSlots(std::move(slots));
    }

    int channels() const { return channels_; }

private:
    const int channels_;
};

using CpuByteTileStorage = CpuTileStorage<std::uint8_t>;
using CpuFloatTileStorage = CpuTileStorage<float>;

} // namespace terrane
