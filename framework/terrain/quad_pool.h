// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/terrain_quad.h"

#include <cassert>
#include <memory>
#include <vector>

namespace terrane {

/// Keeps the quads of one quadtree in blocks of four siblings. Quads never move, so indices and
/// references stay valid; places of dropped quads are used again, and memory is only asked for when
/// the tree grows beyond its largest size so far.
///
/// Whoever keeps data for quads holds an array of capacity() entries, each with the generation that
/// it was made for; an entry whose generation is not that of the quad is stale.
class QuadPool {
public:
    static constexpr int kSiblings = 4;

    /// All indices are below; grows only.
    int capacity() const { return static_cast<int>(chunks_.size()) * kChunk; }
    /// Quads that live.
    int size() const { return size_; }

    TerrainQuad& operator[](int index) {
        assert(index >= 0 && index < capacity() && "QuadPool: no such quad");
        return chunks_[index / kChunk][index % kChunk];
    }
    const TerrainQuad& operator[](int index) const {
        assert(index >= 0 && index < capacity() && "QuadPool: no such quad");
        return chunks_[index / kChunk][index % kChunk];
    }

    /// The only quad without siblings; its index is 0.
    TerrainQuad& createRoot(double ox, double oy, double l, double zmin, double zmax);
    /// Gives a leaf four children, with its elevations.
    void split(TerrainQuad& quad);
    /// Drops all below a quad, which becomes a leaf.
    void collapse(TerrainQuad& quad);

private:
    static constexpr int kChunk = 256;

    int takeBlock();
    void freeBlock(int first);

    std::vector<std::unique_ptr<TerrainQuad[]>> chunks_;
    std::vector<int> freeBlocks_; ///< index of the first quad
    int size_ = 0;
};

} // namespace terrane
