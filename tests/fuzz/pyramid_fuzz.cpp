// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a residual pyramid: all its tiles, which are TIFF files.
#include "plugins/terrain/residual_file.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

using namespace terrane;

namespace {

// Pixels to decode: more of them only cost time.
constexpr std::size_t kMostPixels = 1 << 20;

void readTiles(const ResidualFile& file) {
    const ResidualHeader& h = file.header();
    std::size_t pixels = 0;
    for (int level = 0; level <= h.maxLevel; ++level) {
        const int depth = std::max(level - h.minLevel, 0);
        for (int i = 0; i < 1 << 2 * depth; ++i) {
            const TileId tile{h.rootLevel + level, (h.rootTx << depth) + i % (1 << depth),
                              (h.rootTy << depth) + i / (1 << depth)};
            if (!file.hasTile(tile)) std::abort();
            const auto width = static_cast<std::size_t>(file.tileSize(tile.level) + 5);
            pixels += width * width;
            if (pixels > kMostPixels) return;
            std::string problem;
            const auto values = file.read(tile, problem);
            if (values.empty() == problem.empty()) std::abort();
            if (!values.empty() && values.size() != width * width) std::abort();
        }
    }
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string problem;
    const auto file = ResidualFile::parse(std::as_bytes(std::span(data, size)), problem);
    if (file.has_value() != problem.empty()) std::abort();
    if (!file) return 0;
    const ResidualFile::Faults faults = file->faults();
    if (faults.count > file->tiles()) std::abort();
    if (faults.count > 0 && file->range(faults.first)) std::abort();
    readTiles(*file);
    return 0;
}
