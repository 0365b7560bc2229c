// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/random_camera.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace terrane::test {

double Random::uniform(double low, double high) {
    return low + (high - low) * (engine_() / 4294967296.0);
}

int Random::integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
}

double Random::logarithmic(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
}

glm::dvec3 Random::direction() {
    for (;;) {
        const glm::dvec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        const double length = glm::length(v);
        if (length > 0.1 && length <= 1) return v / length;
    }
}

namespace {

Camera makeCamera(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up,
                  double fieldOfView, double aspect, double viewportWidth) {
    Camera camera;
    camera.position = position;
    camera.fieldOfView = fieldOfView;
    // In two steps, since far from the origin lookAt alone loses digits.
    camera.view.localToCamera =
        glm::translate(glm::lookAt(glm::dvec3(0), target - position, up), -position);
    const double vertical = 2 * std::atan(std::tan(fieldOfView / 2) / aspect);
    camera.view.cameraToScreen = glm::perspective(vertical, aspect, 0.1, 1e6);
    camera.view.viewportWidth = viewportWidth;
    return camera;
}

} // namespace

Camera randomCamera(Random& random, const glm::dvec3& position) {
    return makeCamera(position, position + random.direction(), random.direction(),
                      random.uniform(0.5, 2.4), random.uniform(0.6, 2), random.uniform(200, 2000));
}

Camera cameraAt(const glm::dvec3& position, const glm::dvec3& target, double fieldOfView,
                double viewportWidth) {
    const glm::dvec3 forward = glm::normalize(target - position);
    const glm::dvec3 up = std::abs(forward.z) < 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    return makeCamera(position, target, up, fieldOfView, 4.0 / 3, viewportWidth);
}

Camera randomFlatCamera(Random& random, double size) {
    const double height =
        random.logarithmic(size * 1e-5, size * 3) * (random.integer(0, 9) == 0 ? -1 : 1);
    return randomCamera(
        random, {random.uniform(-1.5, 1.5) * size, random.uniform(-1.5, 1.5) * size, height});
}

Camera randomPlanetCamera(Random& random, double radius) {
    const double height = random.logarithmic(radius * 1e-6, radius * 10);
    const bool below = random.integer(0, 19) == 0;
    const double distance = below ? random.uniform(0.1, 1) * radius : radius + height;
    return randomCamera(random, random.direction() * distance);
}

Camera randomPipeCamera(Random& random, double radius, double size) {
    const double angle = random.uniform(-3.1, 3.1);
    const double r = random.uniform(0, 1) * radius;
    return randomCamera(
        random, {random.uniform(-1.5, 1.5) * size, r * std::sin(angle), -r * std::cos(angle)});
}

} // namespace terrane::test
