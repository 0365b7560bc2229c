// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/brute_force_quadtree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace terrane::test {

BruteForceQuadtree::BruteForceQuadtree(Shape shape, const TerrainNode::Parameters& p,
                                       const Camera& camera, double ground, bool splitInvisible)
    : shape_(shape)
    , p_(p)
    , toScreen_(camera.view.cameraToScreen * camera.view.localToCamera)
    , camera_(camera.position) {
    placeCamera();
    s_ = p.splitFactor * camera.view.viewportWidth / 1024 * std::tan(40 * std::acos(-1.0) / 180) /
         std::tan(camera.fieldOfView / 2);
    s_ = std::max(s_, 1.1);
    for (int level = 0; level <= p.maxLevel; ++level) {
        const int n = 1 << level;
        levels_.emplace_back(static_cast<std::size_t>(n) * n);
        for (int ty = 0; ty < n; ++ty)
            for (int tx = 0; tx < n; ++tx)
                decide(level, tx, ty, ground, splitInvisible);
    }
}

void BruteForceQuadtree::placeCamera() {
    local_ = camera_;
    if (shape_ == Shape::sphere) {
        placeCameraOnPlanet();
    } else if (shape_ == Shape::cylinder) {
        const double R = kPipeRadius;
        local_ = {camera_.x, R * std::atan2(camera_.y, -camera_.z),
                  R - std::hypot(camera_.y, camera_.z)};
    }
}

void BruteForceQuadtree::placeCameraOnPlanet() {
    const glm::dvec3& q = camera_;
    const double R = p_.size;
    const double z = glm::length(q) - R;
    const double ax = std::abs(q.x), ay = std::abs(q.y), az = std::abs(q.z);
    if (az >= ax && az >= ay)
        local_ = q.z > 0 ? glm::dvec3(R * q.x / q.z, R * q.y / q.z, z)
                         : glm::dvec3(std::numeric_limits<double>::infinity());
    else if (ay >= ax)
        local_ = q.y > 0 ? glm::dvec3(R * q.x / q.y, R * (2 - q.z / q.y), z)
                         : glm::dvec3(-R * q.x / q.y, R * (-2 - q.z / q.y), z);
    else
        local_ = q.x > 0 ? glm::dvec3(R * (2 - q.z / q.x), R * q.y / q.x, z)
                         : glm::dvec3(R * (-2 - q.z / q.x), -R * q.y / q.x, z);
    if (std::isfinite(local_.x)) {
        // The singular values along x and y, at the same place of the camera's own face.
        double x = local_.x, y = local_.y;
        x -= std::abs(x) > R ? std::copysign(2 * R, x) : 0;
        y -= std::abs(y) > R ? std::copysign(2 * R, y) : 0;
        const double n2 = x * x + y * y + R * R;
        // |d/dx| = R sqrt(n2 - x^2) / n2
        stretch_ = R / n2 * std::sqrt(n2 - std::min(x * x, y * y));
    }
}

void BruteForceQuadtree::decide(int level, int tx, int ty, double ground, bool splitInvisible) {
    Quad& quad = levels_[level][index(level, tx, ty)];
    if (level > 0 && at(level - 1, tx / 2, ty / 2).leaf) return;
    if (level > 0 && !at(level - 1, tx / 2, ty / 2).exists) return;
    quad.exists = true;
    ++count_;
    const double l = 2 * p_.size / (1 << level);
    const double x = -p_.size + tx * l;
    const double y = -p_.size + ty * l;
    const Visibility above =
        level > 0 ? at(level - 1, tx / 2, ty / 2).visibility : Visibility::partial;
    quad.visibility = above == Visibility::partial ? classify(x, y, l) : above;

    const double up = std::abs(local_.z - std::max(0.0, ground)) / stretch_;
    const double dx = std::min(std::abs(local_.x - x), std::abs(local_.x - (x + l)));
    const double dy = std::min(std::abs(local_.y - y), std::abs(local_.y - (y + l)));
    const bool near = std::isfinite(local_.x) && std::max({up, dx, dy}) < s_ * l;
    quad.leaf =
        !((quad.visibility != Visibility::none || splitInvisible) && near && level < p_.maxLevel);
}

std::vector<glm::dvec3> BruteForceQuadtree::hull(double x, double y, double l) const {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 4; ++i) {
        const double cx = x + (i % 2) * l;
        const double cy = y + (i / 2) * l;
        if (shape_ == Shape::flat) {
            points.push_back({cx, cy, p_.zmin});
            points.push_back({cx, cy, p_.zmax});
        } else if (shape_ == Shape::sphere) {
            const double R = p_.size;
            const double a = (p_.zmax + R) / (p_.zmin + R);
            const double f =
                std::sqrt(2 * l * l / 4 * a * a + (p_.zmax + R) * (p_.zmax + R)) / (p_.zmin + R);
            const glm::dvec3 low =
                (R + p_.zmin) * glm::dvec3(cx, cy, R) / std::sqrt(cx * cx + cy * cy + R * R);
            points.push_back(low);
            points.push_back(low * f);
        } else {
            const double R = kPipeRadius;
            const double r = R - p_.zmax;
            const double f = (R - p_.zmin) / (r * std::cos(l / (2 * R)));
            const double sy = r * std::sin(cy / R), sz = -r * std::cos(cy / R);
            points.push_back({cx, sy, sz});
            points.push_back({cx, sy * f, sz * f});
        }
    }
    return points;
}

Visibility BruteForceQuadtree::classify(double x, double y, double l) const {
    if (shape_ == Shape::cylinder && l / (2 * kPipeRadius) > 1.5) return Visibility::partial;
    const std::vector<glm::dvec3> points = hull(x, y, l);
    std::vector<std::array<double, 6>> sides;
    for (const glm::dvec3& p : points) {
        const glm::dvec4 c = toScreen_ * glm::dvec4(p, 1);
        sides.push_back({c.w + c.x, c.w - c.x, c.w + c.y, c.w - c.y, c.w + c.z, aboveHorizon(p)});
    }
    bool full = true;
    for (int i = 0; i < 6; ++i) {
        int inside = 0;
        for (const auto& side : sides)
            inside += side[i] > 0 ? 1 : 0;
        if (inside == 0) return Visibility::none;
        full = full && inside == 8;
    }
    return full ? Visibility::full : Visibility::partial;
}

double BruteForceQuadtree::aboveHorizon(const glm::dvec3& p) const {
    if (shape_ != Shape::sphere) return 1;
    const double rm = p_.size + std::min(0.0, p_.zmin);
    const double rM = p_.size + p_.zmax;
    const double c2 = glm::dot(camera_, camera_);
    if (c2 < rm * rm) return 1;
    return glm::dot(camera_, p) + std::sqrt((c2 - rm * rm) * (rM * rM - rm * rm)) - rm * rm;
}

} // namespace terrane::test
