// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/residual_file.h"

#include "plugins/terrain/tiff_tile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

namespace terrane {

namespace {

constexpr std::size_t kHeaderBytes = 28;
constexpr std::size_t kEntryBytes = 8; // of the table of tiles
constexpr int kDeepestOfAll = 30;      // coordinates are 32-bit integers
// Levels of full tiles below the first: a table of 4^16 entries would be larger than 32-bit
// offsets reach.
constexpr int kDeepest = 15;
// Twice what the largest tile needs without compression, so that a damaged table does not fill the
// memory.
constexpr std::uint64_t kMostTileBytes = 64 << 20;
static_assert(kMostTileBytes >= 4ull * ResidualFile::kLargestTile * ResidualFile::kLargestTile);

const char* const kCutShort = "the file was cut short";

std::uint32_t unsignedAt(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8 | std::to_integer<std::uint32_t>(bytes[offset + i]);
    return value;
}

// (4^levels - 1) / 3: how many full tiles stand before a level.
std::uint64_t tilesBefore(int levels) {
    return ((std::uint64_t{1} << 2 * levels) - 1) / 3;
}

std::string wrong(const std::string& field, const std::string& found, const std::string& right) {
    return "its " + field + " is " + found + ", not " + right;
}

// Empty when a pyramid can have such a header.
std::string problemOf(const ResidualHeader& h) {
    const auto text = [](int value) { return std::to_string(value); };
    const int largest = ResidualFile::kLargestTile - ResidualFile::kRest;
    if (h.tileSize < 2 || h.tileSize > largest || h.tileSize % 2 != 0)
        return wrong("tile size", text(h.tileSize), "an even number from 2 to " + text(largest));
    const int halvings = std::countr_zero(static_cast<unsigned>(h.tileSize));
    if (h.minLevel < 0 || h.minLevel > halvings)
        return wrong("number of smaller levels", text(h.minLevel),
                     "0 to " + text(halvings) + ", as often as its tile size " + text(h.tileSize) +
                         " can be halved");
    if (h.maxLevel < 0 || h.maxLevel > h.minLevel + kDeepest)
        return wrong("deepest level", text(h.maxLevel), "0 to " + text(h.minLevel + kDeepest));
    const int deepestRoot = kDeepestOfAll - h.maxLevel;
    if (h.rootLevel < 0 || h.rootLevel > deepestRoot)
        return wrong("root level", text(h.rootLevel), "0 to " + text(deepestRoot));
    const int side = 1 << h.rootLevel;
    if (h.rootTx < 0 || h.rootTy < 0 || h.rootTx >= side || h.rootTy >= side)
        return wrong("root tile", text(h.rootTx) + "," + text(h.rootTy),
                     "inside level " + text(h.rootLevel));
    if (h.rootLevel > 0 && h.minLevel > 0)
        return "it is a sub-pyramid, and has smaller levels all the same";
    if (!std::isfinite(h.scale)) return "its scale is no number";
    return {};
}

} // namespace

ResidualFile::ResidualFile(Source source, const ResidualHeader& header)
    : source_(std::move(source))
    , header_(header) {}

std::optional<ResidualFile> ResidualFile::parse(std::shared_ptr<const RandomAccessFile> file,
                                                std::string& problem) {
    const std::uint64_t size = file->size();
    auto read = [file = std::move(file)](std::uint64_t offset, std::span<std::byte> out) {
        return file->read(offset, out);
    };
    return parse(Source{size, std::move(read)}, problem);
}

std::optional<ResidualFile> ResidualFile::parse(std::span<const std::byte> bytes,
                                                std::string& problem) {
    const auto read = [bytes](std::uint64_t offset, std::span<std::byte> out) {
        if (offset > bytes.size() || out.size() > bytes.size() - offset) return false;
        std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
        return true;
    };
    return parse(Source{bytes.size(), read}, problem);
}

std::optional<ResidualFile> ResidualFile::parse(Source source, std::string& problem) {
    if (source.size < kHeaderBytes) {
        problem = "it has " + std::to_string(source.size) + " bytes; its header alone needs " +
                  std::to_string(kHeaderBytes);
        return std::nullopt;
    }
    std::array<std::byte, kHeaderBytes> bytes{};
    if (!source.read(0, bytes)) {
        problem = kCutShort;
        return std::nullopt;
    }
    const auto integer = [&](std::size_t i) { return static_cast<int>(unsignedAt(bytes, 4 * i)); };
    const ResidualHeader header{.minLevel = integer(0),
                                .maxLevel = integer(1),
                                .tileSize = integer(2),
                                .rootLevel = integer(3),
                                .rootTx = integer(4),
                                .rootTy = integer(5),
                                .scale = std::bit_cast<float>(unsignedAt(bytes, 24))};
    problem = problemOf(header);
    if (!problem.empty()) return std::nullopt;

    const int fullLevels = std::max(header.maxLevel - header.minLevel, 0) + 1;
    const std::uint64_t tiles =
        static_cast<std::uint64_t>(header.minLevel) + tilesBefore(fullLevels);
    const std::uint64_t needed = kHeaderBytes + kEntryBytes * tiles;
    if (needed > source.size) {
        problem = "its header speaks of " + std::to_string(tiles) +
                  " tiles, whose table alone needs " + std::to_string(needed) +
                  " bytes, but it has " + std::to_string(source.size);
        return std::nullopt;
    }
    std::vector<std::byte> table(kEntryBytes * tiles);
    if (!source.read(kHeaderBytes, table)) {
        problem = kCutShort;
        return std::nullopt;
    }
    ResidualFile file(std::move(source), header);
    file.firstByte_ = needed;
    file.offsets_.resize(2 * tiles);
    for (std::size_t i = 0; i < file.offsets_.size(); ++i)
        file.offsets_[i] = unsignedAt(table, 4 * i);
    return file;
}

bool ResidualFile::hasTile(const TileId& tile) const {
    const int level = ownLevel(tile.level);
    if (level < 0 || level > header_.maxLevel) return false;
    if (level < header_.minLevel) return tile.tx == 0 && tile.ty == 0;
    const int depth = level - header_.minLevel; // at most kDeepest
    const auto inside = [&](int t, int root) {
        const std::int64_t own = t - (std::int64_t{root} << depth);
        return own >= 0 && own < std::int64_t{1} << depth;
    };
    return inside(tile.tx, header_.rootTx) && inside(tile.ty, header_.rootTy);
}

int ResidualFile::tileSize(int level) const {
    return header_.tileSize >> std::max(header_.minLevel - ownLevel(level), 0);
}

std::size_t ResidualFile::index(const TileId& tile) const {
    assert(hasTile(tile) && "ResidualFile: there is no such tile");
    const int level = ownLevel(tile.level);
    if (level < header_.minLevel) return static_cast<std::size_t>(level);
    const int depth = level - header_.minLevel;
    const std::int64_t x = tile.tx - (std::int64_t{header_.rootTx} << depth);
    const std::int64_t y = tile.ty - (std::int64_t{header_.rootTy} << depth);
    return static_cast<std::size_t>(header_.minLevel + x + (y << depth)) + tilesBefore(depth);
}

TileId ResidualFile::tileAt(std::size_t index) const {
    int level = 0;
    while (level < header_.minLevel && static_cast<std::size_t>(level) < index)
        ++level;
    if (level < header_.minLevel) return {header_.rootLevel + level, 0, 0};
    std::size_t rest = index - static_cast<std::size_t>(header_.minLevel);
    int depth = 0;
    for (; rest >= std::size_t{1} << 2 * depth; ++depth)
        rest -= std::size_t{1} << 2 * depth;
    const std::size_t side = std::size_t{1} << depth;
    return {header_.rootLevel + header_.minLevel + depth,
            (header_.rootTx << depth) + static_cast<int>(rest % side),
            (header_.rootTy << depth) + static_cast<int>(rest / side)};
}

std::optional<ResidualFile::Range> ResidualFile::rangeAt(std::size_t index) const {
    const Range range{firstByte_ + offsets_[2 * index], firstByte_ + offsets_[2 * index + 1]};
    if (range.begin >= range.end || range.end > source_.size) return std::nullopt;
    return range;
}

std::optional<ResidualFile::Range> ResidualFile::range(const TileId& tile) const {
    return rangeAt(index(tile));
}

ResidualFile::Faults ResidualFile::faults() const {
    Faults faults;
    for (std::size_t i = 0; i < tiles(); ++i) {
        const TileId tile = tileAt(i);
        if (!hasTile(tile) || rangeAt(i)) continue; // of small levels only: no tile but an entry
        if (faults.count++ == 0) faults.first = tile;
    }
    return faults;
}

std::vector<std::int16_t> ResidualFile::read(const TileId& tile, std::string& problem) const {
    const auto found = range(tile);
    if (!found) {
        problem = "its bytes are not inside the file";
        return {};
    }
    const std::uint64_t size = found->end - found->begin;
    if (size > kMostTileBytes) {
        problem = "it has " + std::to_string(size) + " bytes, more than any tile needs";
        return {};
    }
    std::vector<std::byte> bytes(size);
    if (!source_.read(found->begin, bytes)) {
        problem = kCutShort;
        return {};
    }
    const int width = tileWidth(tile.level);
    auto image = decodeTiffTile(bytes, header_.tileSize + kRest, problem);
    if (!image) return {};
    if (image->width == width && image->height == width) return std::move(image->values);
    // The original's writer shares the bytes of tiles that are all zero, whatever their sizes
    // (terrain reference 7, trap 18).
    const bool zero = std::all_of(image->values.begin(), image->values.end(),
                                  [](std::int16_t value) { return value == 0; });
    if (zero) return std::vector<std::int16_t>(static_cast<std::size_t>(width) * width);
    problem = "it has " + std::to_string(image->width) + "x" + std::to_string(image->height) +
              " pixels, not " + std::to_string(width) + "x" + std::to_string(width);
    return {};
}

} // namespace terrane
