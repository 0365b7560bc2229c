// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace terrane {

/// Logical coordinates of a quad or tile: `level` 0 is the root, 0 <= tx,ty < 2^level, (0,0) at the
/// lower left.
struct TileId {
    int level = 0;
    int tx = 0;
    int ty = 0;

    bool operator==(const TileId&) const = default;

    TileId parent() const { return {level - 1, tx / 2, ty / 2}; }
    /// @param x,y 0 or 1
    TileId child(int x, int y) const { return {level + 1, 2 * tx + x, 2 * ty + y}; }
    TileId ancestor(int ancestorLevel) const {
        return {ancestorLevel, tx >> (level - ancestorLevel), ty >> (level - ancestorLevel)};
    }
};

/// Physical coordinates of a quad: its lower left corner relative to the centre of the root quad,
/// and its edge length, in the length unit of the root quad.
struct TileCoordinates {
    double ox = 0;
    double oy = 0;
    double size = 0;
};

inline TileCoordinates tileCoordinates(const TileId& tile, double rootQuadSize) {
    const double size = rootQuadSize / static_cast<double>(std::int64_t{1} << tile.level);
    return {size * tile.tx - rootQuadSize / 2, size * tile.ty - rootQuadSize / 2, size};
}

/// A tile among those of all producers that share a cache.
struct TileKey {
    unsigned producer = 0; ///< TileProducer::serial
    TileId tile;
    bool operator==(const TileKey&) const = default;
};

struct TileKeyHash {
    std::size_t operator()(const TileKey& key) const {
        std::uint64_t h = static_cast<std::uint32_t>(key.tile.tx);
        h = h << 32 | static_cast<std::uint32_t>(key.tile.ty);
        h ^= (std::uint64_t{key.producer} << 6 | static_cast<std::uint32_t>(key.tile.level)) *
             0x9E3779B97F4A7C15u; // 2^64 / golden ratio
        h = (h ^ h >> 32) * 0xD6E8FEB86659FD93u;
        return static_cast<std::size_t>(h ^ h >> 32);
    }
};

} // namespace terrane
