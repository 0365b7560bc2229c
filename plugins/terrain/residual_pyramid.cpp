// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/residual_pyramid.h"

#include <algorithm>
#include <cassert>

namespace terrane {

namespace {

// A file of which more tiles are damaged has said enough.
constexpr std::size_t kMostReports = 8;

std::string nameOf(const TileId& tile) {
    return std::to_string(tile.level) + "/" + std::to_string(tile.tx) + "/" +
           std::to_string(tile.ty);
}

} // namespace

ResidualPyramid::ResidualPyramid(Parameters parameters, Diagnostics& diagnostics)
    : parameters_(std::move(parameters))
    , file_(file())
    , diagnostics_(diagnostics) {
    assert(!file_ || (parameters_.delta >= 0 && parameters_.delta <= file_->largestDelta()));
}

void ResidualPyramid::report(const TileId& tile, const std::string& problem) const {
    std::size_t earlier = 0;
    {
        const std::lock_guard lock(mutex_);
        earlier = told_.size();
        if (earlier > kMostReports) return;
        if (std::find(told_.begin(), told_.end(), tile) != told_.end()) return;
        told_.push_back(tile);
    }
    const bool enough = earlier == kMostReports;
    diagnostics_.error("damaged-tile", parameters_.place,
                       "'" + parameters_.name + "' is damaged: " +
                           (enough ? "more tiles" : "tile " + nameOf(tile) + ": " + problem),
                       "a TIFF of 16-bit values; the ground has no residuals there");
}

bool ResidualPyramid::hasTile(const TileId& tile) const {
    return hasFileTile(inFile(tile));
}

bool ResidualPyramid::hasFileTile(const TileId& tile) const {
    if (!file_) return tile.level <= kDeepestWithoutFile;
    return file_->hasTile(tile) ||
           std::any_of(parameters_.parts.begin(), parameters_.parts.end(),
                       [&](const auto& part) { return part->hasTile(tile); });
}

void ResidualPyramid::read(const TileId& tile, float* values, int width) const {
    const ElevationView<float> out{values, static_cast<std::size_t>(width)};
    assert(!file_ || width == file_->header().tileSize + ResidualFile::kRest);
    if (!file_)
        std::fill_n(values, out.stride * out.stride, 0.0f);
    else if (tile.level == 0 && parameters_.delta > 0)
        readRoot(out);
    else
        readFileTile(inFile(tile), out);
}

void ResidualPyramid::readFileTile(const TileId& tile, ElevationView<float> out) const {
    if (!file_->hasTile(tile)) {
        for (const auto& part : parameters_.parts) {
            // Levels stay those of the file; a part that refines this one has no delta.
            if (part->hasTile(tile))
                return part->read(tile, out.values, static_cast<int>(out.stride));
        }
    }
    const int width = file_->tileWidth(tile.level);
    const double metres = static_cast<double>(file_->header().scale) * parameters_.scale;
    const std::vector<std::int16_t> read = units(tile);
    for (int y = 0; y < width; ++y) {
        float* const row = out.row(y);
        if (read.empty()) {
            std::fill_n(row, width, 0.0f);
            continue;
        }
        const std::int16_t* const from = read.data() + static_cast<std::ptrdiff_t>(y) * width;
        std::transform(from, from + width, row,
                       [&](std::int16_t unit) { return static_cast<float>(unit * metres); });
    }
}

// Empty when there are none.
std::vector<std::int16_t> ResidualPyramid::units(const TileId& tile) const {
    if (!file_->hasTile(tile)) return {};
    if (!file_->range(tile)) return {}; // told when the file was opened
    std::string problem;
    std::vector<std::int16_t> values = file_->read(tile, problem);
    if (values.empty()) report(tile, problem);
    return values;
}

// The elevations of level `delta`: one tile, as those of all levels above.
void ResidualPyramid::readRoot(ElevationView<float> out) const {
    std::vector<float> parent, child;
    int width = 0;
    for (int level = 0; level <= parameters_.delta; ++level) {
        const auto parentEdge = static_cast<std::size_t>(width);
        width = file_->tileWidth(level);
        const auto edge = static_cast<std::size_t>(width);
        child.assign(edge * edge, 0.0f);
        const ElevationView<float> view{child.data(), edge};
        readFileTile({level, 0, 0}, view);
        if (level > 0) addUpsampled({parent.data(), parentEdge}, view, width);
        parent.swap(child);
    }
    const ElevationView<const float> whole{parent.data(), static_cast<std::size_t>(width)};
    for (int y = 0; y < width; ++y)
        std::copy_n(whole.row(y), width, out.row(y));
}

} // namespace terrane
