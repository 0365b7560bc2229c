// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace terrane {

enum class Visibility { full, partial, none };

/// Left, right, bottom, top, near, far. A point p is inside a plane when dot(plane, (p,1)) > 0.
using FrustumPlanes = std::array<glm::dvec4, 6>;

/// The planes of the view volume in the space that `toScreen` maps to clip space; not normalised.
FrustumPlanes frustumPlanes(const glm::dmat4& toScreen);

/// Where the convex hull of some points lies with regard to one plane.
Visibility visibility(const glm::dvec4& plane, std::span<const glm::dvec3> points);

/// Where the convex hull of some points lies with regard to a frustum. Conservative: `none` only
/// when one plane has all points outside. The far plane is left out, since terrains reach to the
/// horizon (terrain reference 3.2).
Visibility visibility(const FrustumPlanes& planes, std::span<const glm::dvec3> points);

/// Two tests that both must be passed.
constexpr Visibility both(Visibility a, Visibility b) {
    return a > b ? a : b;
}

} // namespace terrane
