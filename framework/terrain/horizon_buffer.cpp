// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/horizon_buffer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace terrane {

namespace {

// The buffer covers directions of which the tangent is up to 1.5 to each side (terrain reference
// 3.3).
constexpr double kColumnScale = 0.33;

} // namespace

void HorizonBuffer::reset(const glm::dvec3& localCamera, const glm::dvec2& forward) {
    const double length = glm::length(forward);
    active_ = length > 0 && std::isfinite(length);
    if (!active_) return;
    camera_ = localCamera;
    forward_ = forward / length;
    slopes_.fill(-std::numeric_limits<double>::infinity());
}

std::optional<HorizonBuffer::Outline> HorizonBuffer::outline(const QuadBox& box) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Outline result{kInfinity, -kInfinity, kInfinity, -kInfinity};
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 d(box.x + box.size * (i % 2) - camera_.x,
                           box.y + box.size * (i / 2) - camera_.y);
        const double depth = glm::dot(d, forward_);
        if (!(depth > 0)) return std::nullopt;
        const double sideways = d.x * forward_.y - d.y * forward_.x;
        const double column = (kColumnScale * sideways / depth + 0.5) * kColumns;
        result.first = std::min(result.first, column);
        result.last = std::max(result.last, column);
        // Slopes are monotonous in depth and height, so that the corners hold the extremes.
        result.lowest = std::min(result.lowest, (box.zmin - camera_.z) / depth);
        result.highest = std::max(result.highest, (box.zmax - camera_.z) / depth);
    }
    return result;
}

bool HorizonBuffer::isHidden(const Outline& outline) const {
    const double first = std::floor(outline.first);
    const double last = std::max(first, std::ceil(outline.last) - 1);
    // Beyond the buffer nothing is known to hide.
    if (!(first >= 0 && last < kColumns)) return false;
    return std::all_of(slopes_.begin() + static_cast<int>(first),
                       slopes_.begin() + static_cast<int>(last) + 1,
                       [&](double slope) { return outline.highest <= slope; });
}

void HorizonBuffer::raise(const Outline& outline) {
    const double first = std::max(std::ceil(outline.first), 0.0);
    const double end = std::min(std::floor(outline.last), static_cast<double>(kColumns));
    if (!(first < end)) return;
    for (int i = static_cast<int>(first); i < static_cast<int>(end); ++i)
        slopes_[i] = std::max(slopes_[i], outline.lowest);
}

bool HorizonBuffer::isOccluded(const QuadBox& box) const {
    if (!active_) return false;
    const std::optional<Outline> seen = outline(box);
    return seen && isHidden(*seen);
}

bool HorizonBuffer::addOccluder(const QuadBox& box) {
    if (!active_) return false;
    const std::optional<Outline> seen = outline(box);
    if (!seen) return false;
    if (isHidden(*seen)) return true;
    raise(*seen);
    return false;
}

} // namespace terrane
