// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>

namespace terrane {

/// An axis-aligned box. The default is the point at the origin.
struct Box {
    glm::dvec3 minimum{0};
    glm::dvec3 maximum{0};

    glm::dvec3 corner(int index) const {
        return {index & 1 ? maximum.x : minimum.x, index & 2 ? maximum.y : minimum.y,
                index & 4 ? maximum.z : minimum.z};
    }
    Box enlarged(const Box& other) const {
        return {glm::min(minimum, other.minimum), glm::max(maximum, other.maximum)};
    }
    /// The smallest box around this one's eight corners after an affine transformation.
    Box transformed(const glm::dmat4& matrix) const {
        Box result;
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 p(matrix * glm::dvec4(corner(i), 1));
            result.minimum = i == 0 ? p : glm::min(result.minimum, p);
            result.maximum = i == 0 ? p : glm::max(result.maximum, p);
        }
        return result;
    }
};

} // namespace terrane
