// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/deformation.h"

#include <array>
#include <optional>

namespace terrane {

/// The outline of the terrain seen so far: for each of 256 directions in front of the camera the
/// slope below which everything is hidden. Boxes must come front to back. A column stands for the
/// whole interval of directions up to the next, is raised only by boxes that fill it, and must be
/// high enough in all columns that a box touches: no box with a visible point is ever called
/// hidden. That holds on a sphere, too: seen from the local plane, whose straight lines are great
/// circles, lines of sight bend upwards, so that they are lower above an occluder than the straight
/// line to what is behind it. (Terrain reference 3.3, which rounds columns less carefully.)
class HorizonBuffer {
public:
    static constexpr int kColumns = 256;

    /// Nothing is hidden until the next reset.
    void disable() { active_ = false; }
    /// Nothing is hidden yet. Looks along `forward`, local and horizontal, of any length but 0;
    /// else it is disabled.
    void reset(const glm::dvec3& localCamera, const glm::dvec2& forward);
    bool isActive() const { return active_; }

    bool isOccluded(const QuadBox& box) const;
    /// As isOccluded; a box that is not hidden hides from now on what its ground is in front of.
    bool addOccluder(const QuadBox& box);

private:
    struct Outline {
        double first = 0, last = 0;     ///< columns, fractional
        double lowest = 0, highest = 0; ///< slopes
    };
    std::optional<Outline> outline(const QuadBox& box) const;
    bool isHidden(const Outline& outline) const;
    void raise(const Outline& outline);

    bool active_ = false;
    glm::dvec3 camera_{0};
    glm::dvec2 forward_{0, 1};
    std::array<double, kColumns> slopes_{};
};

} // namespace terrane
