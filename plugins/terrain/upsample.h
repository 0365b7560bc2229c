// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace terrane {

/// A square of elevations inside a larger array, row by row from the bottom.
template <class T>
struct ElevationView {
    T* values = nullptr;    ///< the lower left one
    std::size_t stride = 0; ///< from one row to the next

    T* row(int y) const { return values + static_cast<std::ptrdiff_t>(y) * stride; }
    ElevationView at(int x, int y) const { return {row(y) + x, stride}; }
};

/// Adds to a tile, which holds residuals, what its parent has there: even samples are the parent's,
/// odd ones lie on the cubic through four of them (terrain reference 2.4, 4.1). The same as the
/// built-in upsampling shader, in double precision, rounded once.
///
/// @param parent the parent's sample at which the child's tile begins: (0,0) of its array for the
///     left lower child, (n/2,0) for the right lower one, and so on
/// @param width of the child's tile, n + 5
void addUpsampled(ElevationView<const float> parent, ElevationView<float> child, int width);

} // namespace terrane
