// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/deformation.h"

namespace terrane {

/// Bends the square [-R,R]^2 to the upper sixth of a sphere of radius R about the origin: (x,y,z)
/// goes to (R + z) P/|P| with P = (x,y,R). Six terrains, turned, make a planet. The inverse unfolds
/// the sphere like a cube: the four neighbouring faces lie around the square, the opposite face at
/// infinity (terrain reference 2.2).
class SphericalDeformation final : public Deformation {
public:
    explicit SphericalDeformation(double radius);

    glm::dvec3 localToDeformed(const glm::dvec3& local) const override;
    glm::dvec3 deformedToLocal(const glm::dvec3& deformed) const override;
    glm::dmat4 localToDeformedDifferential(const glm::dvec3& local) const override;
    glm::dmat4 deformedToTangentFrame(const glm::dvec3& deformed) const override;
    glm::dvec3 wrapped(const glm::dvec3& local) const override;
    /// Counts what is behind the planet's horizon as invisible, too.
    Visibility visibility(const Viewer& viewer, const QuadBox& box) const override;
    /// Great circles are straight on the camera's own face only.
    bool hasStraightSight(const glm::dvec3& localCamera) const override;
    QuadCorner corner(const glm::dvec2& local) const override;
    glm::dmat3 quadFrame(const QuadBox& box) const override;
    double radius() const override { return radius_; }
    Shape shape() const override { return Shape::sphere; }

private:
    Visibility horizonVisibility(const Viewer& viewer, const QuadBox& box,
                                 std::span<const glm::dvec3> hull) const;

    double radius_;
};

} // namespace terrane
