// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/terrain_resource.h"

#include "resource/build_context.h"
#include "terrain/cylindrical_deformation.h"
#include "terrain/spherical_deformation.h"
#include "terrain/terrain_node.h"

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

namespace terrane {

namespace {

using Shape = Deformation::Shape;

const Words<Shape> kShapeWords{
    {"none", Shape::flat}, {"sphere", Shape::sphere}, {"cylinder", Shape::cylinder}};

struct TerrainNodeDescription : ElementDescription {
    Attr<double> size;
    Attr<double> zmin = 0.0;
    Attr<double> zmax = 0.0;
    Attr<Shape> deform = Shape::flat;
    Attr<double> radius = 0.0;
    Attr<double> splitFactor;
    Attr<int> maxLevel;
    Attr<bool> horizonCulling = true;
};

void check(const TerrainNodeDescription& d, Diagnostics& diagnostics) {
    if (*d.deform == Shape::cylinder && !d.radius.given)
        diagnostics.error("missing-attribute", d.place,
                          "<terrainNode> needs the attribute 'radius' for a cylinder");
    if (*d.zmin > *d.zmax)
        diagnostics.warning("out-of-range", d.zmin.place,
                            "'zmin' is above 'zmax'; the two are exchanged");
    if (!(*d.splitFactor > 1))
        diagnostics.warning("out-of-range", d.splitFactor.place,
                            "quads are split from 1.1 times their size on, whatever 'splitFactor'",
                            "more than 1");
    if (*d.maxLevel > TerrainNode::kDeepestLevel)
        diagnostics.warning("out-of-range", d.maxLevel.place,
                            "no quadtree is deeper than level " +
                                std::to_string(TerrainNode::kDeepestLevel));
}

std::shared_ptr<const Deformation> makeDeformation(const TerrainNodeDescription& d) {
    switch (*d.deform) {
    case Shape::sphere:
        return std::make_shared<SphericalDeformation>(d.size);
    case Shape::cylinder:
        return std::make_shared<CylindricalDeformation>(d.radius);
    case Shape::flat:
        break;
    }
    return std::make_shared<Deformation>();
}

std::shared_ptr<TerrainNode> build(const TerrainNodeDescription& d, BuildContext& context) {
    TerrainNode::Parameters p;
    p.size = d.size;
    std::tie(p.zmin, p.zmax) = std::minmax(*d.zmin, *d.zmax);
    p.deformation = makeDeformation(d);
    p.splitFactor = d.splitFactor;
    p.splitFactorPlace = d.splitFactor.place;
    p.maxLevel = d.maxLevel;
    p.horizonCulling = d.horizonCulling;
    auto terrain = std::make_shared<TerrainNode>(std::move(p));
    if (const auto previous = context.previous<TerrainNode>()) terrain->inherit(*previous);
    return terrain;
}

} // namespace

void declareTerrainNode(Registry& registry) {
    using D = TerrainNodeDescription;
    // Beyond these lengths squares and single-precision uniforms would overflow.
    constexpr double kLongest = 1e15;
    registry
        .resource<TerrainNode, D>("terrainNode",
                                  "A terrain: a square, flat or bent to a sphere or cylinder, that "
                                  "is divided into ever smaller squares near the camera.")
        .example(
            R"(<terrainNode name="ground" size="50000" zmin="-200" zmax="5000" splitFactor="2" maxLevel="13"/>)")
        .attribute("size", &D::size, "half the edge of the square; the radius of a sphere")
        .required()
        .unit("m")
        .above(0)
        .atMost(kLongest)
        .attribute("zmin", &D::zmin, "no ground is lower")
        .unit("m")
        .atLeast(-kLongest)
        .atMost(kLongest)
        .attribute("zmax", &D::zmax, "no ground is higher")
        .unit("m")
        .atLeast(-kLongest)
        .atMost(kLongest)
        .attribute("deform", &D::deform, "what the square is bent to", kShapeWords)
        .otherWordsMeanDefault()
        .attribute("radius", &D::radius, "radius of the cylinder, if it is one")
        .unit("m")
        .above(0)
        .atMost(kLongest)
        .attribute("splitFactor", &D::splitFactor,
                   "a square is divided when it is nearer than this many times its edge, for a "
                   "view 80 degrees and 1024 pixels wide; more than 1, and finer when larger")
        .required()
        .attribute("maxLevel", &D::maxLevel, "level of the smallest squares, 0 for the whole")
        .required()
        .atLeast(0)
        .attribute("horizonCulling", &D::horizonCulling,
                   "whether squares hidden behind nearer ground are left out")
        .trueUnlessFalse()
        .check(check)
        .build(build);
    registry.nameInterface<TerrainNode>("terrain");
}

} // namespace terrane
