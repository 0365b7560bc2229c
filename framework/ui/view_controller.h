// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <limits>
#include <memory>

namespace terrane {

/// Where one looks at, and from where: the point (x0, y0) of the ground, seen from the distance d
/// along a direction. Angles in radians, lengths in metres.
struct View {
    double x0 = 0;    ///< flat: x; planet: longitude; cylinder: x, along the axis
    double y0 = 0;    ///< flat: y; planet: latitude; cylinder: angle around the axis
    double theta = 0; ///< zenith angle: 0 looks straight down
    double phi = 0;   ///< azimuth: 0 looks along y (to the north), counter-clockwise
    double d = 1;     ///< from the camera to the point looked at
    double zoom = 1;  ///< more than 1 looks from farther away through a smaller field of view

    bool operator==(const View&) const = default;
};

/// Turns a view into the camera's frame and projection, in double precision (terrain reference
/// 5.1). This one is for flat terrains and gives the rest to the other shapes. Plain data; not
/// thread-safe.
///
///     TerrainViewController controller;
///     controller.view = {.theta = 1, .d = 50000};
///     camera.localToParent = controller.cameraToWorld();
///     scene.cameraToScreen = controller.cameraToScreen(width, height);
class TerrainViewController {
public:
    virtual ~TerrainViewController() = default;

    View view;
    double groundHeight = 0; ///< of the ground below the camera, metres
    /// The ground below the camera may be as high as this, metres; the camera stays above it.
    double highestGround = -std::numeric_limits<double>::infinity();

    /// The frame of the camera, which looks along its -z: columns right, up, back, position.
    glm::dmat4 cameraToWorld() const;
    glm::dvec3 position() const;
    /// Of the camera above the undisturbed ground (z = 0, sphere, cylinder), metres.
    double height() const { return heightOf(position()); }

    /// Horizontal field of view 80 degrees (less with a zoom); near and far plane follow the height
    /// above the ground. OpenGL's clip space.
    glm::dmat4 cameraToScreen(double widthPixels, double heightPixels) const;

    /// Drags the ground: the point `from` of it comes to where `to` is seen.
    virtual void move(const glm::dvec3& from, const glm::dvec3& to);
    /// Moves along the ground to where the camera looks, metres.
    virtual void forward(double distance);
    /// Turns on the spot: the camera stays where it is, radians.
    virtual void turn(double angle);

    /// A view on the way from `a` (t = 0) to `b` (t = 1). Angles go straight, so that 0 to 2 pi is
    /// a full turn, and the distance grows by equal factors.
    virtual View between(const View& a, const View& b, double t) const;

    /// A view as people write it, in degrees, and back. Lengths stay.
    View fromDegrees(const View& degrees) const;
    View toDegrees(const View& view) const;

    static constexpr double kFieldOfView = 80; ///< horizontal, degrees

protected:
    /// The frame at the point looked at: x, y along the ground, z up, and the point itself.
    struct Place {
        glm::dvec3 x, y, z, origin;
    };
    virtual Place place() const;
    /// Moves a camera that would be in the ground out of it.
    virtual glm::dvec3 aboveFloor(const glm::dvec3& position) const;
    virtual double heightOf(const glm::dvec3& position) const;
    /// How many radians a unit of x0 and of y0 in degrees is: 1 for lengths.
    virtual glm::dvec2 groundUnits() const { return {1, 1}; }
    /// Of the camera, at least, metres.
    double floorHeight() const { return std::max(groundHeight, highestGround) + clearance(); }
    /// Least height above the ground, metres.
    virtual double clearance() const { return 1; }
};

/// For a planet around the origin, seen from outside.
class PlanetViewController : public TerrainViewController {
public:
    explicit PlanetViewController(double radius)
        : radius_(radius) {}
    double radius() const { return radius_; }

    void move(const glm::dvec3& from, const glm::dvec3& to) override;
    void forward(double distance) override;
    void turn(double angle) override;
    /// The point looked at goes along a great circle.
    View between(const View& a, const View& b, double t) const override;

protected:
    Place place() const override;
    glm::dvec3 aboveFloor(const glm::dvec3& position) const override;
    double heightOf(const glm::dvec3& position) const override;
    glm::dvec2 groundUnits() const override { return glm::radians(glm::dvec2(1)); }
    double clearance() const override { return 0.5; }

private:
    double radius_;
};

/// For a hollow cylinder around the x axis, seen from inside.
class CylinderViewController : public TerrainViewController {
public:
    explicit CylinderViewController(double radius)
        : radius_(radius) {}
    double radius() const { return radius_; }

    void move(const glm::dvec3& from, const glm::dvec3& to) override;
    void forward(double distance) override;
    void turn(double angle) override;

protected:
    Place place() const override;
    glm::dvec3 aboveFloor(const glm::dvec3& position) const override;
    double heightOf(const glm::dvec3& position) const override;
    glm::dvec2 groundUnits() const override { return {1, glm::radians(1.0)}; }

private:
    double radius_;
};

} // namespace terrane
