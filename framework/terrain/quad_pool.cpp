// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/quad_pool.h"

namespace terrane {

int QuadPool::takeBlock() {
    if (freeBlocks_.empty()) {
        const int start = capacity();
        chunks_.push_back(std::make_unique<TerrainQuad[]>(kChunk));
        // Room for all blocks at once, so that dropping quads never asks for memory.
        freeBlocks_.reserve(static_cast<std::size_t>(capacity() / kSiblings));
        for (int first = start + kChunk - kSiblings; first >= start; first -= kSiblings)
            freeBlocks_.push_back(first);
        for (int i = start; i < start + kChunk; ++i)
            (*this)[i].index = i;
    }
    const int first = freeBlocks_.back();
    freeBlocks_.pop_back();
    return first;
}

void QuadPool::freeBlock(int first) {
    for (int i = first; i < first + kSiblings; ++i) {
        TerrainQuad& quad = (*this)[i];
        const std::uint32_t generation = quad.generation + 1;
        quad = {};
        quad.index = i;
        quad.generation = generation;
    }
    size_ -= kSiblings;
    freeBlocks_.push_back(first);
}

TerrainQuad& QuadPool::createRoot(double ox, double oy, double l, double zmin, double zmax) {
    assert(chunks_.empty() && "QuadPool::createRoot: there is a root already");
    TerrainQuad& root = (*this)[takeBlock()];
    root.level = 0;
    root.ox = ox;
    root.oy = oy;
    root.l = l;
    root.zmin = zmin;
    root.zmax = zmax;
    size_ = 1;
    return root;
}

void QuadPool::split(TerrainQuad& quad) {
    assert(quad.isAlive() && quad.isLeaf() && "QuadPool::split: not a leaf");
    quad.firstChild = takeBlock();
    size_ += kSiblings;
    const double half = quad.l / 2;
    for (int i = 0; i < kSiblings; ++i) {
        TerrainQuad& child = (*this)[quad.firstChild + i];
        child.level = quad.level + 1;
        child.tx = 2 * quad.tx + i % 2;
        child.ty = 2 * quad.ty + i / 2;
        child.ox = quad.ox + half * (i % 2);
        child.oy = quad.oy + half * (i / 2);
        child.l = half;
        child.zmin = quad.zmin;
        child.zmax = quad.zmax;
        child.parent = quad.index;
    }
}

void QuadPool::collapse(TerrainQuad& quad) {
    if (quad.isLeaf()) return;
    for (int i = 0; i < kSiblings; ++i)
        collapse((*this)[quad.firstChild + i]);
    freeBlock(quad.firstChild);
    quad.firstChild = -1;
}

} // namespace terrane
