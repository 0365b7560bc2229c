// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrain/random_camera.h"
#include "terrain/terrain_node.h"

#include <vector>

namespace terrane::test {

enum class Shape { flat, sphere, cylinder };

constexpr double kFlatSize = 50000; // half edge, also of the cylinder's square
constexpr double kRadius = 6360000; // of the sphere
constexpr double kPipeRadius = 20000;

/// The quadtree by its definition (terrain reference 3.1, 3.2), quad by quad and in other terms
/// than the product: clip coordinates, no planes; formulas of the deformations written out.
class BruteForceQuadtree {
public:
    struct Quad {
        bool exists = false;
        bool leaf = true;
        Visibility visibility = Visibility::none;
    };

    /// @param p must outlive the tree; with elevations that are those of all quads
    BruteForceQuadtree(Shape shape, const TerrainNode::Parameters& p, const Camera& camera,
                       double ground, bool splitInvisible);

    const Quad& at(int level, int tx, int ty) const { return levels_[level][index(level, tx, ty)]; }
    int count() const { return count_; }
    double splitDistance() const { return s_; }

private:
    static std::size_t index(int level, int tx, int ty) {
        return static_cast<std::size_t>(ty) * (1 << level) + tx;
    }
    void placeCamera();
    void placeCameraOnPlanet();
    void decide(int level, int tx, int ty, double ground, bool splitInvisible);
    std::vector<glm::dvec3> hull(double x, double y, double l) const;
    Visibility classify(double x, double y, double l) const;
    double aboveHorizon(const glm::dvec3& p) const;

    Shape shape_;
    const TerrainNode::Parameters& p_;
    glm::dmat4 toScreen_;
    glm::dvec3 camera_;
    glm::dvec3 local_{0};
    double stretch_ = 1;
    double s_ = 0;
    int count_ = 0;
    std::vector<std::vector<Quad>> levels_;
};

} // namespace terrane::test
