// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/upsample.h"

#include <array>
#include <vector>

namespace terrane {

namespace {

// Child sample i lies at the parent's i/2 + 1; the four samples around it start one before.
constexpr std::array<double, 4> kOdd{-1.0 / 16, 9.0 / 16, 9.0 / 16, -1.0 / 16};

template <class T>
double between(const T* z, std::size_t step, int child) {
    if (child % 2 == 0) return z[step];
    double sum = 0;
    for (std::size_t i = 0; i < kOdd.size(); ++i)
        sum += kOdd[i] * z[i * step];
    return sum;
}

} // namespace

void addUpsampled(ElevationView<const float> parent, ElevationView<float> child, int width) {
    // First along the rows of the parent, then across them.
    const int parentRows = width / 2 + 3;
    const auto columns = static_cast<std::size_t>(width);
    std::vector<double> wide(columns * static_cast<std::size_t>(parentRows));
    for (int y = 0; y < parentRows; ++y)
        for (int x = 0; x < width; ++x)
            wide[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)] =
                between(parent.row(y) + x / 2, 1, x);
    for (int y = 0; y < width; ++y) {
        const double* const rows = wide.data() + static_cast<std::size_t>(y / 2) * columns;
        float* const out = child.row(y);
        for (int x = 0; x < width; ++x)
            out[x] = static_cast<float>(out[x] + between(rows + x, columns, y));
    }
}

} // namespace terrane
