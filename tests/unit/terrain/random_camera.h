// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/terrain_state.h"

#include <random>

namespace terrane::test {

/// Random numbers, the same in every run and with every library.
class Random {
public:
    explicit Random(unsigned seed)
        : engine_(seed) {}

    double uniform(double low, double high);
    int integer(int low, int high); ///< both included
    double logarithmic(double low, double high);
    glm::dvec3 direction();

private:
    std::mt19937 engine_;
};

struct Camera {
    TerrainView view;
    glm::dvec3 position{0}; ///< in deformed space
    double fieldOfView = 0; ///< horizontal, radians
};

/// A camera at a place of deformed space that looks somewhere, with some lens and viewport.
Camera randomCamera(Random& random, const glm::dvec3& position);

/// Looks from one point at another.
Camera cameraAt(const glm::dvec3& position, const glm::dvec3& target, double fieldOfView = 1.4,
                double viewportWidth = 1024);

/// Somewhere above a square of half edge `size`, or beside it.
Camera randomFlatCamera(Random& random, double size);
/// Anywhere above, sometimes below, the surface of a ball.
Camera randomPlanetCamera(Random& random, double radius);
/// Inside a pipe about the x axis.
Camera randomPipeCamera(Random& random, double radius, double size);

} // namespace terrane::test
