// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/deformation.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace terrane {

glm::dvec3 Deformation::localToDeformed(const glm::dvec3& local) const {
    return local;
}

glm::dvec3 Deformation::deformedToLocal(const glm::dvec3& deformed) const {
    return deformed;
}

glm::dmat4 Deformation::localToDeformedDifferential(const glm::dvec3& local) const {
    const bool finite = !glm::any(glm::isnan(local)) && !glm::any(glm::isinf(local));
    if (!finite) return glm::dmat4(1);
    return glm::translate(glm::dmat4(1), {local.x, local.y, 0.0});
}

glm::dmat4 Deformation::deformedToTangentFrame(const glm::dvec3& deformed) const {
    return glm::translate(glm::dmat4(1), {-deformed.x, -deformed.y, 0.0});
}

double Deformation::stretch(const glm::dvec3& local) const {
    const glm::dmat4 differential = localToDeformedDifferential(wrapped(local));
    return std::max(glm::length(differential[0]), glm::length(differential[1]));
}

Visibility Deformation::visibility(const Viewer& viewer, const QuadBox& box) const {
    const double x1 = box.x + box.size;
    const double y1 = box.y + box.size;
    const std::array<glm::dvec3, 8> corners{{{box.x, box.y, box.zmin},
                                             {x1, box.y, box.zmin},
                                             {box.x, y1, box.zmin},
                                             {x1, y1, box.zmin},
                                             {box.x, box.y, box.zmax},
                                             {x1, box.y, box.zmax},
                                             {box.x, y1, box.zmax},
                                             {x1, y1, box.zmax}}};
    return terrane::visibility(viewer.planes, corners);
}

bool Deformation::hasStraightSight(const glm::dvec3&) const {
    return true;
}

QuadCorner Deformation::corner(const glm::dvec2& local) const {
    return {glm::dvec3(local, 0), {0, 0, 1}, 1};
}

glm::dmat3 Deformation::quadFrame(const QuadBox&) const {
    return glm::dmat3(1);
}

} // namespace terrane
