// SPDX-License-Identifier: BSD-3-Clause
#include "ui/view_controller.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <string>
#include <vector>

using namespace terrane;

namespace {

constexpr double kRadius = 6360000;
const double kQuarter = glm::half_pi<double>();

void checkNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    INFO(a.x, " ", a.y, " ", a.z, " instead of ", b.x, " ", b.y, " ", b.z);
    CHECK(glm::distance(a, b) <= tolerance);
}

struct Shape {
    const char* name;
    std::unique_ptr<TerrainViewController> controller;
    double scale; ///< metres
};

std::vector<Shape> shapes() {
    std::vector<Shape> list;
    list.push_back({"flat", std::make_unique<TerrainViewController>(), 50000});
    list.push_back({"planet", std::make_unique<PlanetViewController>(kRadius), kRadius});
    list.push_back({"cylinder", std::make_unique<CylinderViewController>(10000), 3000});
    return list;
}

glm::dvec3 clip(const glm::dmat4& projection, const glm::dvec3& p) {
    const glm::dvec4 c = projection * glm::dvec4(p, 1);
    return glm::dvec3(c) / c.w;
}

} // namespace

TEST_CASE("a camera looks straight down at zenith angle 0, with the north on top") {
    struct Row {
        const char* name;
        std::shared_ptr<TerrainViewController> controller;
        View view;
        glm::dvec3 position, right, up;
    };
    const auto planet = std::make_shared<PlanetViewController>(kRadius);
    const auto cylinder = std::make_shared<CylinderViewController>(1000);
    const Row rows[] = {
        {"flat",
         std::make_shared<TerrainViewController>(),
         {.x0 = 3, .y0 = 4, .d = 50},
         {3, 4, 50},
         {1, 0, 0},
         {0, 1, 0}},
        {"planet, 0 0", planet, {.d = kRadius}, {2 * kRadius, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {"planet, 90 east",
         planet,
         {.x0 = kQuarter, .d = kRadius},
         {0, 2 * kRadius, 0},
         {-1, 0, 0},
         {0, 0, 1}},
        {"planet, north pole",
         planet,
         {.y0 = kQuarter, .d = kRadius},
         {0, 0, 2 * kRadius},
         {0, 1, 0},
         {-1, 0, 0}},
        {"cylinder, bottom", cylinder, {.x0 = 7, .d = 100}, {7, 0, -900}, {1, 0, 0}, {0, 1, 0}},
        {"cylinder, a quarter round",
         cylinder,
         {.y0 = kQuarter, .d = 100},
         {0, 900, 0},
         {1, 0, 0},
         {0, 0, 1}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        row.controller->view = row.view;
        const glm::dmat4 frame = row.controller->cameraToWorld();
        checkNear(row.controller->position(), row.position, 1e-6);
        checkNear(glm::dvec3(frame[0]), row.right, 1e-12);
        checkNear(glm::dvec3(frame[1]), row.up, 1e-12);
    }
}

TEST_CASE("zenith angle and azimuth turn the camera as the formulas say") {
    TerrainViewController flat;
    flat.groundHeight = 10;
    flat.view = {.x0 = 100, .y0 = 200, .theta = 0.7, .phi = 0.3, .d = 1000};
    const glm::dvec3 back(std::sin(0.3) * std::sin(0.7), -std::cos(0.3) * std::sin(0.7),
                          std::cos(0.7));
    checkNear(flat.position(), glm::dvec3(100, 200, 10) + back * 1000.0, 1e-9);
    checkNear(glm::dvec3(flat.cameraToWorld()[2]), back, 1e-12);
    CHECK(flat.height() == doctest::Approx(10 + 1000 * std::cos(0.7)));

    flat.view.zoom = 3;
    checkNear(flat.position(), glm::dvec3(100, 200, 10) + back * 3000.0, 1e-9);
}

TEST_CASE("every camera frame is orthonormal and looks at its point") {
    for (Shape& shape : shapes()) {
        CAPTURE(shape.name);
        TerrainViewController& c = *shape.controller;
        c.view = {.x0 = 0.4, .y0 = 0.9, .theta = 0.6, .phi = 2, .d = shape.scale};
        const glm::dmat3 axes(c.cameraToWorld());
        const glm::dmat3 unit = glm::transpose(axes) * axes;
        for (int i = 0; i < 3; ++i)
            checkNear(unit[i], glm::dmat3(1)[i], 1e-12);
        CHECK(glm::determinant(axes) == doctest::Approx(1));
        // The view of an infinitely near camera is the point itself.
        const glm::dvec3 position = c.position();
        const glm::dvec3 seen = position - axes[2] * shape.scale;
        c.view.theta = 0;
        checkNear(c.position() - glm::dvec3(c.cameraToWorld()[2]) * shape.scale, seen,
                  1e-9 * shape.scale);
    }
}

TEST_CASE("no camera goes below its ground") {
    const View below{.x0 = 0.1, .y0 = 0.2, .theta = 2.5, .d = 500};
    TerrainViewController flat;
    PlanetViewController planet(kRadius);
    CylinderViewController cylinder(10000);
    for (TerrainViewController* c : {&flat, static_cast<TerrainViewController*>(&planet),
                                     static_cast<TerrainViewController*>(&cylinder)}) {
        c->view = below;
        c->groundHeight = 123;
    }
    CHECK(flat.height() == doctest::Approx(124));
    CHECK(planet.height() == doctest::Approx(123.5));
    CHECK(cylinder.height() == doctest::Approx(124));
    planet.view = {.x0 = 1, .theta = glm::pi<double>(), .d = kRadius + 123};
    CHECK(planet.height() == doctest::Approx(123.5)); // even from the centre
}

TEST_CASE("the projection sees 80 degrees from side to side") {
    TerrainViewController c;
    c.view.d = 1000;
    const glm::dmat4 m = c.cameraToScreen(1024, 768);
    const double tangent = std::tan(glm::radians(40.0));
    checkNear(clip(m, {tangent * 500, 0, -500}) * glm::dvec3(1, 1, 0), {1, 0, 0}, 1e-12);
    checkNear(clip(m, {0, tangent * 0.75 * 500, -500}) * glm::dvec3(1, 1, 0), {0, 1, 0}, 1e-12);
    CHECK(clip(m, {0, 0, -100}).z == doctest::Approx(-1)); // near: a tenth of the height
    CHECK(clip(m, {0, 0, -1e9}).z == doctest::Approx(1));  // far: a million times the height

    c.groundHeight = 500; // moves the point looked at, too: the height above ground stays
    CHECK(clip(c.cameraToScreen(1024, 768), {0, 0, -100}).z == doctest::Approx(-1));
}

TEST_CASE("a zoom narrows the projection around the distance") {
    TerrainViewController c;
    c.view = {.d = 1000, .zoom = 50};
    const double tangent = std::tan(glm::radians(40.0)) * 0.75 / 50;
    const glm::dmat4 m = c.cameraToScreen(1024, 768);
    CHECK(clip(m, {0, tangent * 50000, -50000}).y == doctest::Approx(1));
    CHECK(clip(m, {0, 0, -50000 * (1 - 10 * tangent)}).z == doctest::Approx(-1));
    CHECK(clip(m, {0, 0, -50000 * (1 + 10 * tangent)}).z == doctest::Approx(1));
}

TEST_CASE("dragging keeps the ground under the pointer") {
    TerrainViewController flat;
    flat.view = {.x0 = 10, .y0 = 20, .d = 5};
    flat.move({1, 2, 0}, {4, 0, 0});
    CHECK(flat.view.x0 == 7);
    CHECK(flat.view.y0 == 22);

    PlanetViewController planet(kRadius);
    planet.view = {.x0 = 0.5, .y0 = 1.5};
    planet.move({kRadius, 0, 0}, {0, kRadius, 0});
    CHECK(planet.view.x0 == doctest::Approx(0.5 - kQuarter));
    planet.move({0, 0, kRadius}, {kRadius, 0, 0}); // the latitude ends at the pole
    CHECK(planet.view.y0 == doctest::Approx(kQuarter));

    CylinderViewController cylinder(100);
    cylinder.move({0, 0, -100}, {5, 100, 0});
    CHECK(cylinder.view.x0 == doctest::Approx(-5));
    CHECK(cylinder.view.y0 == doctest::Approx(-kQuarter));
}

TEST_CASE("going forward follows the azimuth") {
    TerrainViewController flat;
    flat.view.phi = kQuarter;
    flat.forward(100);
    CHECK(flat.view.x0 == doctest::Approx(-100));
    CHECK(flat.view.y0 == doctest::Approx(0));

    PlanetViewController planet(kRadius);
    planet.forward(kRadius * 0.25);
    CHECK(planet.view.y0 == doctest::Approx(0.25));
    planet.view = {.phi = -kQuarter};
    planet.forward(kRadius * 0.25);
    CHECK(planet.view.x0 == doctest::Approx(0.25));

    CylinderViewController cylinder(100);
    cylinder.forward(25);
    CHECK(cylinder.view.y0 == doctest::Approx(0.25));
}

TEST_CASE("turning leaves the camera where it is") {
    TerrainViewController flat;
    flat.view = {.x0 = 3, .y0 = 4, .theta = 1, .phi = 0.2, .d = 1000};
    const glm::dvec3 before = flat.position();
    flat.turn(0.7);
    checkNear(flat.position(), before, 1e-9);
    CHECK(flat.view.phi == doctest::Approx(0.9));

    PlanetViewController planet(kRadius);
    planet.view = {.x0 = 0.3, .y0 = 0.2, .theta = 1, .phi = 0.2, .d = 1000};
    const glm::dvec3 above = planet.position();
    planet.turn(0.7);
    checkNear(planet.position(), above, 1); // the azimuth's north differs a little
}

TEST_CASE("a flight starts and ends at its views and passes between them") {
    for (Shape& shape : shapes()) {
        CAPTURE(shape.name);
        const View a{.x0 = 0.1, .y0 = 0.2, .theta = 0, .phi = 0, .d = 100};
        const View b{.x0 = 0.5, .y0 = -0.3, .theta = 1, .phi = 6, .d = 10000};
        for (const double t : {0.0, 1.0}) {
            const View v = shape.controller->between(a, b, t);
            const View& end = t == 0 ? a : b;
            CHECK(v.x0 == doctest::Approx(end.x0));
            CHECK(v.y0 == doctest::Approx(end.y0));
            CHECK(v.phi == doctest::Approx(end.phi));
            CHECK(v.d == doctest::Approx(end.d));
        }
        const View middle = shape.controller->between(a, b, 0.5);
        CHECK(middle.d == doctest::Approx(1000));
        CHECK(middle.phi == doctest::Approx(3));
    }
    // Over the date line rather than round the planet.
    PlanetViewController planet(kRadius);
    const View v = planet.between({.x0 = 3}, {.x0 = -3}, 0.5);
    CHECK(std::abs(v.x0) == doctest::Approx(glm::pi<double>()));
}

TEST_CASE("people write angles in degrees and lengths in metres") {
    const View written{.x0 = 90, .y0 = 45, .theta = 60, .phi = 180, .d = 1000};
    for (Shape& shape : shapes()) {
        CAPTURE(shape.name);
        const View v = shape.controller->fromDegrees(written);
        const std::string name = shape.name;
        CHECK(v.x0 == doctest::Approx(name == "planet" ? kQuarter : 90));
        CHECK(v.y0 == doctest::Approx(name == "flat" ? 45 : kQuarter / 2));
        CHECK(v.theta == doctest::Approx(glm::pi<double>() / 3));
        CHECK(v.phi == doctest::Approx(glm::pi<double>()));
        CHECK(v.d == 1000);
        CHECK(shape.controller->toDegrees(v).y0 == doctest::Approx(45));
    }
}
