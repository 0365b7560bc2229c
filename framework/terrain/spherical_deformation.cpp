// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/spherical_deformation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace terrane {

namespace {

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// East, north and up at a direction from the centre; at the poles of y, where east has no
// meaning, any.
glm::dmat3 tangentAxes(const glm::dvec3& direction) {
    const double length = glm::length(direction);
    const glm::dvec3 up = length > 0 ? direction / length : glm::dvec3(0, 0, 1);
    const glm::dvec3 sideways = glm::cross(glm::dvec3(0, 1, 0), up);
    const double sine = glm::length(sideways);
    const glm::dvec3 east = sine > 0 ? sideways / sine : glm::dvec3(1, 0, 0);
    return {east, glm::cross(up, east), up};
}

} // namespace

SphericalDeformation::SphericalDeformation(double radius)
    : radius_(radius) {
    assert(radius > 0 && "SphericalDeformation: the radius must be positive");
}

glm::dvec3 SphericalDeformation::localToDeformed(const glm::dvec3& local) const {
    return (radius_ + local.z) * glm::normalize(glm::dvec3(local.x, local.y, radius_));
}

glm::dvec3 SphericalDeformation::deformedToLocal(const glm::dvec3& q) const {
    const double R = radius_;
    const double height = glm::length(q) - R;
    const glm::dvec3 size = glm::abs(q);
    if (size.z >= size.x && size.z >= size.y) {
        if (q.z > 0) return {R * q.x / q.z, R * q.y / q.z, height};
        if (q.z == 0) return {0, 0, height}; // the centre: any direction would do
        return glm::dvec3(std::numeric_limits<double>::infinity());
    }
    if (size.y >= size.x) {
        if (q.y > 0) return {R * q.x / q.y, R * (2 - q.z / q.y), height};
        return {-R * q.x / q.y, R * (-2 - q.z / q.y), height};
    }
    if (q.x > 0) return {R * (2 - q.z / q.x), R * q.y / q.x, height};
    return {R * (-2 - q.z / q.x), -R * q.y / q.x, height};
}

glm::dmat4 SphericalDeformation::localToDeformedDifferential(const glm::dvec3& local) const {
    if (!isFinite(local)) return glm::dmat4(1);
    const double R = radius_;
    const double x = local.x;
    const double y = local.y;
    const double s = x * x + y * y + R * R;
    const double c0 = 1 / std::sqrt(s);
    const double c1 = c0 * R / s;
    const glm::dvec3 P(x, y, R);
    return {glm::dvec4(glm::dvec3(y * y + R * R, -x * y, -x * R) * c1, 0),
            glm::dvec4(glm::dvec3(-x * y, x * x + R * R, -y * R) * c1, 0), glm::dvec4(P * c0, 0),
            glm::dvec4(P * (R * c0), 1)};
}

glm::dmat4 SphericalDeformation::deformedToTangentFrame(const glm::dvec3& deformed) const {
    glm::dmat4 frame(glm::transpose(tangentAxes(deformed)));
    frame[3] = {0, 0, -radius_, 1};
    return frame;
}

glm::dvec3 SphericalDeformation::wrapped(const glm::dvec3& local) const {
    if (!isFinite(local)) return local;
    const auto wrap = [this](double v) {
        const double turns = (v + radius_) / (2 * radius_);
        return (turns - std::floor(turns)) * 2 * radius_ - radius_;
    };
    return {wrap(local.x), wrap(local.y), local.z};
}

Visibility SphericalDeformation::visibility(const Viewer& viewer, const QuadBox& box) const {
    // A hull of the curved box: its lower corners, and these moved outwards until the plane through
    // them is above everything (terrain reference 3.2; tight for a root quad, generous elsewhere).
    const double low = radius_ + box.zmin;
    const double high = radius_ + box.zmax;
    if (low <= 0) return Visibility::partial; // the centre of the planet is ground: no hull
    const double half = box.size / 2 * high / low;
    const double scale = std::sqrt(2 * half * half + high * high) / low;
    std::array<glm::dvec3, 8> hull;
    for (int i = 0; i < 4; ++i) {
        const double x = box.x + box.size * (i % 2);
        const double y = box.y + box.size * (i / 2);
        hull[i] = localToDeformed({x, y, box.zmin});
        hull[i + 4] = hull[i] * scale;
    }
    const Visibility frustum = terrane::visibility(viewer.planes, hull);
    if (frustum == Visibility::none) return frustum;
    return both(frustum, horizonVisibility(viewer, box, hull));
}

// A point of radius rM is hidden by a ball of radius rm when it is more than acos(rm/|c|) +
// acos(rm/rM) away from the camera c as seen from the centre, which is a plane.
Visibility SphericalDeformation::horizonVisibility(const Viewer& viewer, const QuadBox& box,
                                                   std::span<const glm::dvec3> hull) const {
    const double rm = radius_ + std::min({0.0, box.zmin, viewer.lowestGround});
    const double rM = radius_ + box.zmax;
    const double camera2 = glm::dot(viewer.camera, viewer.camera);
    const double rm2 = rm * rm;
    if (rm <= 0 || camera2 < rm2) return Visibility::full; // no horizon from below the ground
    const double offset = std::sqrt((camera2 - rm2) * std::max(rM * rM - rm2, 0.0)) - rm2;
    if (!std::isfinite(offset)) return Visibility::full;
    return terrane::visibility(glm::dvec4(viewer.camera, offset), hull);
}

bool SphericalDeformation::hasStraightSight(const glm::dvec3& localCamera) const {
    return std::abs(localCamera.x) <= radius_ && std::abs(localCamera.y) <= radius_;
}

QuadCorner SphericalDeformation::corner(const glm::dvec2& local) const {
    const glm::dvec3 P(local, radius_);
    const double norm = glm::length(P);
    const glm::dvec3 vertical = P / norm;
    return {vertical * radius_, vertical, norm};
}

glm::dmat3 SphericalDeformation::quadFrame(const QuadBox& box) const {
    return tangentAxes({box.x + box.size / 2, box.y + box.size / 2, radius_});
}

} // namespace terrane
