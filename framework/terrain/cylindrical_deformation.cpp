// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/cylindrical_deformation.h"

#include <array>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace terrane {

CylindricalDeformation::CylindricalDeformation(double radius)
    : radius_(radius) {
    assert(radius > 0 && "CylindricalDeformation: the radius must be positive");
}

glm::dvec3 CylindricalDeformation::localToDeformed(const glm::dvec3& local) const {
    const double angle = local.y / radius_;
    const double r = radius_ - local.z;
    return {local.x, r * std::sin(angle), -r * std::cos(angle)};
}

glm::dvec3 CylindricalDeformation::deformedToLocal(const glm::dvec3& deformed) const {
    return {deformed.x, radius_ * std::atan2(deformed.y, -deformed.z),
            radius_ - std::hypot(deformed.y, deformed.z)};
}

glm::dmat4 CylindricalDeformation::localToDeformedDifferential(const glm::dvec3& local) const {
    if (!std::isfinite(local.x) || !std::isfinite(local.y)) return glm::dmat4(1);
    const double angle = local.y / radius_;
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    return {{1, 0, 0, 0}, {0, c, s, 0}, {0, -s, c, 0}, {local.x, radius_ * s, -radius_ * c, 1}};
}

glm::dmat4 CylindricalDeformation::deformedToTangentFrame(const glm::dvec3& deformed) const {
    const double r = std::hypot(deformed.y, deformed.z);
    const glm::dvec3 up = r > 0 ? glm::dvec3(0, -deformed.y / r, -deformed.z / r)
                                : glm::dvec3(0, 0, 1); // on the axis any direction is up
    const glm::dvec3 east(1, 0, 0);
    const glm::dmat3 axes(east, glm::cross(up, east), up);
    const glm::dmat3 turned = glm::transpose(axes);
    const glm::dvec3 origin(deformed.x, -radius_ * up.y, -radius_ * up.z);
    glm::dmat4 frame(turned);
    frame[3] = glm::dvec4(-(turned * origin), 1);
    return frame;
}

Visibility CylindricalDeformation::visibility(const Viewer& viewer, const QuadBox& box) const {
    // The hull of a piece of pipe: its inner corners, and these moved outwards until the plane
    // through them is outside of the outer wall (terrain reference 3.2).
    const double inner = radius_ - box.zmax;
    const double outer = radius_ - box.zmin;
    const double halfAngle = box.size / (2 * radius_);
    constexpr double kWidest = 1.5; // radians, a little less than a half turn in all
    if (inner <= 0 || halfAngle > kWidest) return Visibility::partial;
    const double scale = outer / (inner * std::cos(halfAngle));
    std::array<glm::dvec3, 8> hull;
    for (int i = 0; i < 4; ++i) {
        const double x = box.x + box.size * (i % 2);
        const double y = box.y + box.size * (i / 2);
        hull[i] = localToDeformed({x, y, box.zmax});
        hull[i + 4] = {hull[i].x, hull[i].y * scale, hull[i].z * scale};
    }
    return terrane::visibility(viewer.planes, hull);
}

} // namespace terrane
