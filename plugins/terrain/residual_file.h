// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/random_access_file.h"
#include "producer/tile_id.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace terrane {

struct ResidualHeader {
    int minLevel = 0;  ///< levels whose one tile is smaller than tileSize
    int maxLevel = 0;  ///< the deepest level; the root has level 0
    int tileSize = 0;  ///< n: tiles have (n+5)^2 values, borders of 2 and the shared edge included
    int rootLevel = 0; ///< where a sub-pyramid's root stands in the pyramid that it refines
    int rootTx = 0, rootTy = 0;
    float scale = 1; ///< metres of a unit
};

/// A pyramid of residuals, DEM.dat: elevations in the root tile, differences to the upsampled level
/// above in all others (terrain reference 4.1). Levels 0 to minLevel are one tile each, of doubling
/// size; from there on all tiles have the same size, and each level four times as many.
///
/// Immutable, so any thread may read. Keeps the table of the tiles, and fetches the bytes of a tile
/// when it is asked for. Takes any bytes, and a file that is cut short in the meantime: what is
/// wrong with the whole is told by parse(), what is wrong with a tile by read().
class ResidualFile {
public:
    static constexpr int kBorder = 2;
    /// Values along the edge of a tile beyond n.
    static constexpr int kRest = 2 * kBorder + 1;
    static constexpr int kLargestTile = 4096; ///< n + 5; the original's limit is 255

    /// Nothing, with the reason for people to read, when the header is no header of such a file or
    /// the table of its tiles is not all there. Offsets of single tiles may still be wrong.
    static std::optional<ResidualFile> parse(std::shared_ptr<const RandomAccessFile> file,
                                             std::string& problem);
    /// @param bytes of such a file; must outlive what is returned
    static std::optional<ResidualFile> parse(std::span<const std::byte> bytes,
                                             std::string& problem);

    const ResidualHeader& header() const { return header_; }
    /// The deepest level that is one tile, which may be the root of what is asked for (terrain
    /// reference 4.1, delta).
    int largestDelta() const { return std::min(header_.minLevel, header_.maxLevel); }
    std::size_t tiles() const { return offsets_.size() / 2; }

    /// Levels and coordinates of tiles are those of the pyramid that a sub-pyramid belongs to.
    bool hasTile(const TileId& tile) const;
    /// Edge of the tiles of a level, without borders and with them.
    int tileSize(int level) const;
    int tileWidth(int level) const { return tileSize(level) + kRest; }

    /// Bytes of a tile, counted from the start of the file. Tiles may share theirs.
    struct Range {
        std::uint64_t begin = 0;
        std::uint64_t end = 0;
    };
    /// Of a tile that there is. Nothing when it is empty or not inside the file.
    std::optional<Range> range(const TileId& tile) const;

    /// How many tiles have no range, and the first of them in the order of levels.
    struct Faults {
        std::size_t count = 0;
        TileId first;
    };
    Faults faults() const;

    /// The values of a tile that there is, in units of the file: tileWidth(level)^2, row by row
    /// from the bottom. Empty, with the reason, when the tile is damaged.
    std::vector<std::int16_t> read(const TileId& tile, std::string& problem) const;

private:
    /// Where the bytes come from.
    struct Source {
        std::uint64_t size = 0;
        /// Fills the span with the bytes from an offset on; false when they are not all there.
        std::function<bool(std::uint64_t offset, std::span<std::byte> out)> read;
    };
    ResidualFile(Source source, const ResidualHeader& header);
    static std::optional<ResidualFile> parse(Source source, std::string& problem);

    /// Level of a tile, counted from the root of this file.
    int ownLevel(int level) const { return level - header_.rootLevel; }
    std::size_t index(const TileId& tile) const;
    std::optional<Range> rangeAt(std::size_t index) const;
    TileId tileAt(std::size_t index) const;

    Source source_;
    ResidualHeader header_;
    std::uint64_t firstByte_ = 0;        ///< that offsets count from
    std::vector<std::uint32_t> offsets_; ///< begin and end of each tile
};

} // namespace terrane
