// SPDX-License-Identifier: BSD-3-Clause
#include "core/frustum.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace terrane {

FrustumPlanes frustumPlanes(const glm::dmat4& toScreen) {
    // Inside means -w < x < w and so on: each plane is the last row plus or minus another.
    const glm::dmat4 rows = glm::transpose(toScreen);
    return {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
            rows[3] - rows[1], rows[3] + rows[2], rows[3] - rows[2]};
}

Visibility visibility(const glm::dvec4& plane, std::span<const glm::dvec3> points) {
    bool inside = false;
    bool outside = false;
    for (const glm::dvec3& p : points) {
        const bool in = glm::dot(glm::dvec3(plane), p) + plane.w > 0;
        (in ? inside : outside) = true;
    }
    if (!inside) return Visibility::none;
    return outside ? Visibility::partial : Visibility::full;
}

Visibility visibility(const FrustumPlanes& planes, std::span<const glm::dvec3> points) {
    constexpr int kFar = 5;
    Visibility result = Visibility::full;
    for (int i = 0; i < kFar; ++i) {
        result = both(result, visibility(planes[i], points));
        if (result == Visibility::none) break;
    }
    return result;
}

} // namespace terrane
