// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>

namespace terrane::test {

/// From the local axes of a face of a planet (east, north, outwards) to the planet's, by quarter
/// turns: counter-clockwise, first about the y axis, then about the x axis (terrain reference 2.2).
template <class T>
glm::vec<3, T> toPlanet(int face, glm::vec<3, T> v) {
    const auto aboutX = [](const glm::vec<3, T>& a) { return glm::vec<3, T>(a.x, -a.z, a.y); };
    const auto aboutY = [](const glm::vec<3, T>& a) { return glm::vec<3, T>(a.z, a.y, -a.x); };
    if (face == 1) return v;
    if (face == 6) return aboutX(aboutX(v));
    for (int i = 2; i < face; ++i)
        v = aboutY(v);
    return aboutX(v);
}

} // namespace terrane::test
