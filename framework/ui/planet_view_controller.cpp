// SPDX-License-Identifier: BSD-3-Clause
#include "ui/view_controller.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace terrane {

namespace {

glm::dvec3 direction(double longitude, double latitude) {
    const double c = std::cos(latitude);
    return {std::cos(longitude) * c, std::sin(longitude) * c, std::sin(latitude)};
}
glm::dvec3 east(double longitude) {
    return {-std::sin(longitude), std::cos(longitude), 0};
}
glm::dvec3 north(double longitude, double latitude) {
    const double s = std::sin(latitude);
    return {-std::cos(longitude) * s, -std::sin(longitude) * s, std::cos(latitude)};
}

double longitude(const glm::dvec3& p) {
    return std::atan2(p.y, p.x);
}
double latitude(const glm::dvec3& p) {
    return std::asin(std::clamp(p.z / glm::length(p), -1.0, 1.0));
}

/// Along the great circle that leaves the unit vector p along the unit tangent t.
glm::dvec3 step(const glm::dvec3& p, const glm::dvec3& t, double angle) {
    return p * std::cos(angle) + t * std::sin(angle);
}

} // namespace

TerrainViewController::Place PlanetViewController::place() const {
    const glm::dvec3 up = direction(view.x0, view.y0);
    return {east(view.x0), north(view.x0, view.y0), up, up * (radius_ + groundHeight)};
}

glm::dvec3 PlanetViewController::aboveFloor(const glm::dvec3& position) const {
    const double floor = radius_ + floorHeight();
    const double distance = glm::length(position);
    if (distance >= floor) return position;
    // The centre has no direction of its own.
    return distance > 0 ? position * (floor / distance) : direction(view.x0, view.y0) * floor;
}

double PlanetViewController::heightOf(const glm::dvec3& position) const {
    return glm::length(position) - radius_;
}

void PlanetViewController::move(const glm::dvec3& from, const glm::dvec3& to) {
    view.x0 -= longitude(to) - longitude(from);
    view.y0 = std::clamp(view.y0 - (latitude(to) - latitude(from)), -glm::half_pi<double>(),
                         glm::half_pi<double>());
}

void PlanetViewController::forward(double distance) {
    const Place p = place();
    const glm::dvec3 ahead = p.y * std::cos(view.phi) - p.x * std::sin(view.phi);
    const glm::dvec3 to = step(p.z, ahead, distance / radius_);
    view.x0 = longitude(to);
    view.y0 = latitude(to);
}

void PlanetViewController::turn(double angle) {
    const double arc = view.d * view.zoom * std::sin(view.theta) / radius_;
    const Place p = place();
    const glm::dvec3 behind = p.x * std::sin(view.phi) - p.y * std::cos(view.phi);
    const glm::dvec3 camera = step(p.z, behind, arc);
    const glm::dvec3 ahead = p.z * std::sin(arc) - behind * std::cos(arc); // at the camera
    const glm::dvec3 left = glm::cross(camera, ahead);
    const glm::dvec3 to = step(camera, ahead * std::cos(angle) + left * std::sin(angle), arc);
    view.x0 = longitude(to);
    view.y0 = latitude(to);
    view.phi += angle;
}

View PlanetViewController::between(const View& a, const View& b, double t) const {
    View v = TerrainViewController::between(a, b, t);
    const glm::dvec3 from = direction(a.x0, a.y0), to = direction(b.x0, b.y0);
    const glm::dvec3 normal = glm::cross(from, to);
    const double sine = glm::length(normal);
    if (sine < 1e-12) return v; // equal, or opposite: no great circle is the one
    const double arc = std::atan2(sine, glm::dot(from, to));
    const glm::dvec3 p = step(from, glm::cross(normal / sine, from), t * arc);
    v.x0 = longitude(p);
    v.y0 = latitude(p);
    return v;
}

} // namespace terrane
