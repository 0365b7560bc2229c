// SPDX-License-Identifier: BSD-3-Clause
#include "ui/view_controller.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace terrane {

namespace {

/// Standard OpenGL perspective from the vertical field of view.
glm::dmat4 perspective(double tanHalfVertical, double aspect, double near, double far) {
    glm::dmat4 m(0);
    m[0][0] = 1 / (tanHalfVertical * aspect);
    m[1][1] = 1 / tanHalfVertical;
    m[2][2] = -(far + near) / (far - near);
    m[2][3] = -1;
    m[3][2] = -2 * far * near / (far - near);
    return m;
}

} // namespace

TerrainViewController::Place TerrainViewController::place() const {
    return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {view.x0, view.y0, groundHeight}};
}

glm::dmat4 TerrainViewController::cameraToWorld() const {
    const Place p = place();
    const double ct = std::cos(view.theta), st = std::sin(view.theta);
    const double cp = std::cos(view.phi), sp = std::sin(view.phi);
    const glm::dvec3 right = p.x * cp + p.y * sp;
    const glm::dvec3 up = -p.x * (sp * ct) + p.y * (cp * ct) + p.z * st;
    const glm::dvec3 back = p.x * (sp * st) - p.y * (cp * st) + p.z * ct;
    const glm::dvec3 position = aboveFloor(p.origin + back * (view.d * view.zoom));
    return {{right, 0}, {up, 0}, {back, 0}, {position, 1}};
}

glm::dvec3 TerrainViewController::position() const {
    return glm::dvec3(cameraToWorld()[3]);
}

glm::dmat4 TerrainViewController::cameraToScreen(double widthPixels, double heightPixels) const {
    const double aspect = widthPixels / heightPixels;
    const double tangent = std::tan(glm::radians(kFieldOfView) / 2) / aspect;
    if (view.zoom <= 1) {
        const double above = std::max(height() - groundHeight, clearance());
        return perspective(tangent, aspect, 0.1 * above, 1e6 * above);
    }
    const double zoomed = tangent / view.zoom;
    const double distance = view.d * view.zoom;
    return perspective(zoomed, aspect, distance * std::max(1 - 10 * zoomed, 0.1),
                       distance * std::min(1 + 10 * zoomed, 10.0));
}

void TerrainViewController::move(const glm::dvec3& from, const glm::dvec3& to) {
    view.x0 -= to.x - from.x;
    view.y0 -= to.y - from.y;
}

void TerrainViewController::forward(double distance) {
    view.x0 -= std::sin(view.phi) * distance;
    view.y0 += std::cos(view.phi) * distance;
}

void TerrainViewController::turn(double angle) {
    const double l = view.d * view.zoom * std::sin(view.theta); // horizontally to the camera
    const double after = view.phi + angle;
    view.x0 += l * (std::sin(view.phi) - std::sin(after));
    view.y0 += l * (std::cos(after) - std::cos(view.phi));
    view.phi = after;
}

View TerrainViewController::between(const View& a, const View& b, double t) const {
    View v;
    v.x0 = glm::mix(a.x0, b.x0, t);
    v.y0 = glm::mix(a.y0, b.y0, t);
    v.theta = glm::mix(a.theta, b.theta, t);
    v.phi = glm::mix(a.phi, b.phi, t);
    const bool positive = a.d > 0 && b.d > 0;
    v.d = positive ? a.d * std::pow(b.d / a.d, t) : glm::mix(a.d, b.d, t);
    v.zoom = glm::mix(a.zoom, b.zoom, t);
    return v;
}

View TerrainViewController::fromDegrees(const View& degrees) const {
    View v = degrees;
    const glm::dvec2 units = groundUnits();
    v.x0 *= units.x;
    v.y0 *= units.y;
    v.theta = glm::radians(v.theta);
    v.phi = glm::radians(v.phi);
    return v;
}

View TerrainViewController::toDegrees(const View& view) const {
    View v = view;
    const glm::dvec2 units = groundUnits();
    v.x0 /= units.x;
    v.y0 /= units.y;
    v.theta = glm::degrees(v.theta);
    v.phi = glm::degrees(v.phi);
    return v;
}

glm::dvec3 TerrainViewController::aboveFloor(const glm::dvec3& position) const {
    return {position.x, position.y, std::max(position.z, floorHeight())};
}

double TerrainViewController::heightOf(const glm::dvec3& position) const {
    return position.z;
}

} // namespace terrane
