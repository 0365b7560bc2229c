// SPDX-License-Identifier: BSD-3-Clause
#include "ui/view_controller.h"

#include <cmath>

namespace terrane {

TerrainViewController::Place CylinderViewController::place() const {
    const double c = std::cos(view.y0), s = std::sin(view.y0);
    const double r = radius_ - groundHeight;
    return {{1, 0, 0}, {0, c, s}, {0, -s, c}, {view.x0, r * s, -r * c}};
}

glm::dvec3 CylinderViewController::aboveFloor(const glm::dvec3& position) const {
    const double floor = radius_ - floorHeight();
    const double fromAxis = std::hypot(position.y, position.z);
    if (fromAxis <= floor) return position;
    const double scale = floor / fromAxis;
    return {position.x, position.y * scale, position.z * scale};
}

double CylinderViewController::heightOf(const glm::dvec3& position) const {
    return radius_ - std::hypot(position.y, position.z);
}

void CylinderViewController::move(const glm::dvec3& from, const glm::dvec3& to) {
    const auto angle = [](const glm::dvec3& p) { return std::atan2(p.y, -p.z); };
    view.x0 -= to.x - from.x;
    view.y0 -= angle(to) - angle(from);
}

// The flat formulas, with y0 measured along the ground.

void CylinderViewController::forward(double distance) {
    view.y0 *= radius_;
    TerrainViewController::forward(distance);
    view.y0 /= radius_;
}

void CylinderViewController::turn(double angle) {
    view.y0 *= radius_;
    TerrainViewController::turn(angle);
    view.y0 /= radius_;
}

} // namespace terrane
