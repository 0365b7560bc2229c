// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/deformation.h"

#include <cstdint>

namespace terrane {

/// A square of a terrain's quadtree.
struct TerrainQuad {
    /// Where the quad stands in its pool; never changes.
    int index = 0;
    /// Counts the lives of this place in the pool: what somebody kept for a quad belongs to another
    /// one, or to none, as soon as the generation differs.
    std::uint32_t generation = 0;

    int level = -1;        ///< 0 for the root; -1 while the place is free
    int tx = 0, ty = 0;    ///< column and row among the 2^level of this level, from the lower left
    double ox = 0, oy = 0; ///< lower left corner, local metres from the centre of the root quad
    double l = 0;          ///< edge, local metres

    /// Elevations of the ground: what somebody measured, or else what is likely after those of the
    /// parent quad.
    double zmin = 0, zmax = 0;
    bool measured = false;

    Visibility visibility = Visibility::none;
    bool occluded = false; ///< hidden behind nearer ground
    /// A leaf that would be visible, were its ground outside of what it inherited: somebody should
    /// measure it soon.
    bool doubtful = false;

    int parent = -1;     ///< index; -1 for the root
    int firstChild = -1; ///< index of the first of four: lower left, lower right, upper left, upper
                         ///< right; -1 for a leaf

    bool isAlive() const { return level >= 0; }
    bool isLeaf() const { return firstChild < 0; }
    bool isVisible() const { return visibility != Visibility::none; }
    QuadBox box() const { return {ox, oy, l, zmin, zmax}; }
    /// Which of its four children is at a local point, or nearest to it as coordinates count.
    int childAt(const glm::dvec2& local) const {
        return (local.x < ox + l / 2 ? 0 : 1) + (local.y < oy + l / 2 ? 0 : 2);
    }
};

} // namespace terrane
