// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/deformation.h"

namespace terrane {

/// Bends the plane to the inside of a cylinder of radius R about the x axis: (x,y,z) goes to
/// (x, r sin a, -r cos a) with a = y/R and r = R - z (terrain reference 2.2). The quad corners for
/// shaders stay flat: a shader bends vertices itself, with the radius.
class CylindricalDeformation final : public Deformation {
public:
    explicit CylindricalDeformation(double radius);

    glm::dvec3 localToDeformed(const glm::dvec3& local) const override;
    glm::dvec3 deformedToLocal(const glm::dvec3& deformed) const override;
    glm::dmat4 localToDeformedDifferential(const glm::dvec3& local) const override;
    glm::dmat4 deformedToTangentFrame(const glm::dvec3& deformed) const override;
    Visibility visibility(const Viewer& viewer, const QuadBox& box) const override;
    /// Never: the ground rises towards both sides.
    bool hasStraightSight(const glm::dvec3&) const override { return false; }
    double radius() const override { return radius_; }
    Shape shape() const override { return Shape::cylinder; }

private:
    double radius_;
};

} // namespace terrane
