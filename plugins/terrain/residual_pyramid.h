// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "plugins/terrain/residual_file.h"
#include "plugins/terrain/upsample.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace terrane {

/// Residuals in metres, from a file and from others that refine parts of it; or zero everywhere,
/// without a file. Any thread may read tiles. A tile that is damaged is told once, at the place
/// where the archive names the file, and read as zero.
class ResidualPyramid {
public:
    static constexpr int kDeepestWithoutFile = 32; // terrain reference 1.7

    struct Parameters {
        std::string name; ///< of the file, for messages
        Place place;      ///< where the archive names it
        std::optional<ResidualFile> file;
        float scale = 1; ///< multiplies the file's own
        /// Levels of the file's tiles are that much more than those that are asked for, and the
        /// root stands for all that is above it; from 0 to the file's largestDelta().
        int delta = 0;
        std::vector<std::unique_ptr<ResidualPyramid>> parts; ///< with files
    };

    /// @param diagnostics of the player; must outlive the pyramid
    ResidualPyramid(Parameters parameters, Diagnostics& diagnostics);

    /// Null without a file.
    const ResidualFile* file() const { return parameters_.file ? &*parameters_.file : nullptr; }
    int delta() const { return parameters_.delta; }

    bool hasTile(const TileId& tile) const;
    /// Fills in a tile: for the root the elevations, for the others what is to be added to those of
    /// the parent, upsampled.
    /// @param width of the whole array; smaller tiles, which only the first levels have, stand in
    ///     its lower left part
    void read(const TileId& tile, float* values, int width) const;

private:
    /// A level of the file instead of one that is asked for.
    TileId inFile(const TileId& tile) const {
        return {tile.level + parameters_.delta, tile.tx, tile.ty};
    }
    bool hasFileTile(const TileId& tile) const;
    void readFileTile(const TileId& tile, ElevationView<float> out) const;
    void readRoot(ElevationView<float> out) const;
    std::vector<std::int16_t> units(const TileId& tile) const;

    void report(const TileId& tile, const std::string& problem) const;

    const Parameters parameters_;
    const ResidualFile* const file_;
    Diagnostics& diagnostics_;

    mutable std::mutex mutex_;
    mutable std::vector<TileId> told_; ///< damaged tiles
};

} // namespace terrane
