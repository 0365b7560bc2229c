// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/frustum.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace terrane {

/// The space above a quad in local coordinates: x..x+size, y..y+size, zmin..zmax.
struct QuadBox {
    double x = 0, y = 0, size = 0;
    double zmin = 0, zmax = 0;
};

/// What visibility depends on, in deformed space.
struct Viewer {
    FrustumPlanes planes{};
    glm::dvec3 camera{0};
    /// No ground of the whole terrain is lower; what stands behind a planet's horizon follows.
    double lowestGround = 0;
};

/// A corner of a quad at elevation 0, from which shaders build the points above it.
struct QuadCorner {
    glm::dvec3 position; ///< deformed
    glm::dvec3 vertical; ///< deformed, of length 1
    double norm = 1;     ///< of (x,y,R) on a sphere, else 1
};

/// Maps the flat *local* space of a terrain, in which the quadtree is a square of the plane z = 0,
/// to the *deformed* space that is drawn, both in the frame of the terrain's scene node; z becomes
/// the height above the deformed plane. This class is the identity; subclasses bend the plane.
/// Metres, double precision. Immutable, so any thread may ask it (terrain reference 2.2, 3.2).
class Deformation {
public:
    enum class Shape { flat, sphere, cylinder };

    virtual ~Deformation() = default;
    virtual Shape shape() const { return Shape::flat; }

    virtual glm::dvec3 localToDeformed(const glm::dvec3& local) const;
    /// Infinite where the inverse has no value.
    virtual glm::dvec3 deformedToLocal(const glm::dvec3& deformed) const;

    /// The affine map that approximates localToDeformed(local + d), of a small d, at z = 0. The
    /// identity where `local` is not finite.
    virtual glm::dmat4 localToDeformedDifferential(const glm::dvec3& local) const;

    /// Maps deformed space to the orthonormal frame whose xy plane is tangent to the deformed
    /// plane below a deformed point, with its origin there.
    virtual glm::dmat4 deformedToTangentFrame(const glm::dvec3& deformed) const;

    /// Brings a local point beside the root quad, which may come out of deformedToLocal, to the
    /// point of the root quad that is stretched alike.
    virtual glm::dvec3 wrapped(const glm::dvec3& local) const { return local; }

    /// How much the deformation stretches horizontal lengths at most: the longer of the first two
    /// columns of the differential at wrapped(local).
    double stretch(const glm::dvec3& local) const;

    /// Whether any part of a box may be seen. Never `none` for a box with a visible point, never
    /// `full` for one that the frustum cuts.
    virtual Visibility visibility(const Viewer& viewer, const QuadBox& box) const;

    /// True where lines of sight from a camera cover straight lines of the local plane, so that a
    /// horizon can be kept as one height for each azimuth.
    virtual bool hasStraightSight(const glm::dvec3& localCamera) const;

    virtual QuadCorner corner(const glm::dvec2& local) const;
    /// The directions of deformed space in which the normals of a quad are told: east, north and up
    /// at its centre.
    virtual glm::dmat3 quadFrame(const QuadBox& box) const;
    /// Of the sphere or cylinder, 0 when flat.
    virtual double radius() const { return 0; }
};

} // namespace terrane
