// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/noise.h"
#include "plugins/terrain/noise_image.h"

#include "plugin_terrain/planet_cube.h"

#include <doctest/doctest.h>
#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

using namespace terrane;
using terrane::test::toPlanet;

namespace {

// Edges of a tile, as the bits of an edge code.
enum Edge { bottom, right, top, left };

bool bit(int code, int edge) {
    return (code >> edge & 1) != 0;
}

// The texel that a shader reads for texel (h,v) of a tile of this edge code, see NoiseTile.
template <class T>
T turned(const NoiseImage<T>& image, int code, int h, int v, int channel = 0) {
    const NoiseTile tile = noiseTile(code);
    const std::array<int, 4> c{h, v, image.width - 1 - h, image.width - 1 - v};
    return image(c[tile.rotation], c[(tile.rotation + 1) % 4], tile.layer, channel);
}

// The texel `along` an edge, counted from the left or the bottom, and `inside` it; inside is
// negative on the other side. `edge0` is the texel index of the left and bottom edge.
std::array<int, 2> texelAtEdge(int width, int edge, int along, int inside, int edge0) {
    const int near = edge0 + inside;
    const int far = width - 1 - near;
    switch (edge) {
    case bottom:
        return {along, near};
    case right:
        return {far, along};
    case top:
        return {along, far};
    default:
        return {near, along};
    }
}

// True when two tiles show the same noise on both sides of an edge that they share.
// @param shared how many texels of each tile lie on the edge: 1 elevation, 0 ortho
template <class T>
bool agree(const NoiseImage<T>& image, int shared, int codeA, int edgeA, int codeB, int edgeB,
           bool reversed) {
    const int w = image.width;
    for (int along = 0; along < w; ++along) {
        const int alongB = reversed ? w - 1 - along : along;
        for (int depth = -2; depth < 2 + shared; ++depth) {
            // The texels of B run the other way through the edge.
            const int depthB = shared == 1 ? -depth : -1 - depth;
            const auto a = texelAtEdge(w, edgeA, along, depth, 2);
            const auto b = texelAtEdge(w, edgeB, alongB, depthB, 2);
            for (int c = 0; c < image.channels; ++c)
                if (turned(image, codeA, a[0], a[1], c) != turned(image, codeB, b[0], b[1], c))
                    return false;
        }
    }
    return true;
}

struct TileEdge {
    int face, tx, ty, edge;
    bool reversed; // runs against the order of its end points
};

using Key = std::array<int, 6>;

// All outer edges of all tiles of a planet at a level, by their end points on the cube.
std::map<Key, std::vector<TileEdge>> tileEdges(int level) {
    const int o = 1 << level;
    std::map<Key, std::vector<TileEdge>> edges;
    for (int face = 1; face <= 6; ++face)
        for (int ty = 0; ty < o; ++ty)
            for (int tx = 0; tx < o; ++tx)
                for (int edge = 0; edge < 4; ++edge) {
                    const int x = 2 * (tx + (edge == right ? 1 : 0)) - o;
                    const int y = 2 * (ty + (edge == top ? 1 : 0)) - o;
                    const bool horizontal = edge == bottom || edge == top;
                    glm::ivec3 p = toPlanet(face, glm::ivec3(x, y, o));
                    glm::ivec3 q = toPlanet(
                        face, glm::ivec3(x + (horizontal ? 2 : 0), y + (horizontal ? 0 : 2), o));
                    const bool reversed =
                        std::make_tuple(q.x, q.y, q.z) < std::make_tuple(p.x, p.y, p.z);
                    if (reversed) std::swap(p, q);
                    edges[{p.x, p.y, p.z, q.x, q.y, q.z}].push_back({face, tx, ty, edge, reversed});
                }
    return edges;
}

} // namespace

TEST_CASE("The lattice has the reference permutation and finite gradients") {
    const GradientNoise noise;
    const std::array<int, 8> expected{240, 0, 51, 162, 173, 77, 6, 135};
    for (int i = 0; i < 8; ++i)
        CHECK(noise.permutation()[i] == expected[i]);
    std::array<int, 256> seen{};
    for (int value : noise.permutation())
        ++seen[value];
    for (int count : seen)
        CHECK(count == 1);
    for (int i = 0; i < 256; ++i)
        CHECK(std::isfinite(noise(0.3f + static_cast<float>(i), 0.7f)));
}

TEST_CASE("Gradient noise has its reference values") {
    const GradientNoise noise;
    CHECK(noise(0.5f, 0) == doctest::Approx(0.0192582).epsilon(1e-5));
    CHECK(noise(3.25f, 7.75f) == doctest::Approx(-0.204786).epsilon(1e-5));
    CHECK(noise(17, -3) == 0);
    CHECK(noise(17.25f, 5.5f) == noise(17.25f + 256, 5.5f - 256));
    // Any coordinate is defined.
    CHECK(std::isfinite(noise(-9000.5f, 4.3e9f)));
}

TEST_CASE("Edge codes have their reference values") {
    const GradientNoise noise;
    const std::array<int, 7> roots{13, 5, 7, 10, 13, 0, 5};
    for (int face = 0; face <= 6; ++face) {
        CAPTURE(face);
        CHECK(noiseEdgeCode(noise, face, 0, 0, 0) == roots[face]);
    }
    const std::array<std::array<int, 4>, 6> levelOne{
        {{6, 9, 9, 4}, {7, 10, 3, 12}, {13, 0, 3, 8}, {5, 2, 7, 8}, {15, 8, 5, 0}, {8, 1, 6, 10}}};
    for (int face = 1; face <= 6; ++face)
        for (int i = 0; i < 4; ++i) {
            CAPTURE(face);
            CAPTURE(i);
            CHECK(noiseEdgeCode(noise, face, 1, i % 2, i / 2) == levelOne[face - 1][i]);
        }
    CHECK(noiseEdgeCode(noise, 1, 5, 3, 7) == 4);
    CHECK(noiseEdgeCode(noise, 1, 9, 511, 511) == 7);
}

TEST_CASE("The elevation noise has its reference values") {
    const NoiseImage<float> image = makeElevationNoise(101);
    CHECK(image.values.size() == 6u * 101 * 101);
    CHECK(image(50, 50, 0) == doctest::Approx(-0.430654).epsilon(1e-5));
    CHECK(image(50, 2, 0) == doctest::Approx(-0.480414).epsilon(1e-5));
    CHECK(image(5, 5, 0) == doctest::Approx(0.887492).epsilon(1e-5));
    CHECK(image(0, 50, 0) == doctest::Approx(0.988162).epsilon(1e-5));
    CHECK(image(50, 50, 5) == doctest::Approx(-0.239809).epsilon(1e-5));
    for (int layer = 0; layer < kNoiseLayers; ++layer)
        for (int v = 0; v < 5; ++v)
            for (int h = 0; h < 5; ++h) {
                CHECK(image(h, v, layer) == 0);
                CHECK(image(100 - h, 100 - v, layer) == 0);
            }
}

TEST_CASE("The smallest noise images are made") {
    for (int width : {5, 7, 9, 11, 13})
        CHECK(makeElevationNoise(width).width == width);
    for (int width : {4, 6, 8, 9, 10})
        CHECK(makeOrthoNoise(width).values.front() == 128);
}

TEST_CASE("A quarter turn gives each edge code the layer it needs") {
    for (int code = 0; code < 16; ++code) {
        CAPTURE(code);
        const NoiseTile tile = noiseTile(code);
        // Turning by R quarter turns moves edge i to edge i + R.
        const int layerCode = kNoiseLayerCodes[tile.layer];
        int turnedCode = 0;
        for (int edge = 0; edge < 4; ++edge)
            if (bit(layerCode, edge)) turnedCode |= 1 << (edge + tile.rotation) % 4;
        CHECK(turnedCode == code);
    }
}

TEST_CASE("All pairs of neighbouring tiles agree around the edge that they share") {
    const NoiseImage<float> elevation = makeElevationNoise(29);
    const NoiseImage<std::uint8_t> ortho = makeOrthoNoise(28);
    int pairs = 0;
    for (int a = 0; a < 16; ++a)
        for (int b = 0; b < 16; ++b) {
            CAPTURE(a);
            CAPTURE(b);
            const bool sideBySide = bit(a, right) == bit(b, left);
            CHECK(agree(elevation, 1, a, right, b, left, false) == sideBySide);
            CHECK(agree(ortho, 0, a, right, b, left, false) == sideBySide);
            const bool oneAbove = bit(a, top) == bit(b, bottom);
            CHECK(agree(elevation, 1, a, top, b, bottom, false) == oneAbove);
            CHECK(agree(ortho, 0, a, top, b, bottom, false) == oneAbove);
            pairs += (sideBySide ? 1 : 0) + (oneAbove ? 1 : 0);
        }
    CHECK(pairs == 256);
}

TEST_CASE("Tiles on both sides of all edges of a planet agree, the twelve cube edges included") {
    const GradientNoise noise;
    const NoiseImage<float> elevation = makeElevationNoise(13);
    const NoiseImage<std::uint8_t> ortho = makeOrthoNoise(12);
    for (int level : {0, 1, 2, 4}) {
        CAPTURE(level);
        const int o = 1 << level;
        const auto edges = tileEdges(level);
        CHECK(edges.size() == 12u * o * o);
        int cubeEdges = 0;
        for (const auto& [key, sides] : edges) {
            REQUIRE(sides.size() == 2);
            const TileEdge& a = sides[0];
            const TileEdge& b = sides[1];
            const int codeA = noiseEdgeCode(noise, a.face, level, a.tx, a.ty);
            const int codeB = noiseEdgeCode(noise, b.face, level, b.tx, b.ty);
            CAPTURE(a.face);
            CAPTURE(b.face);
            CHECK(bit(codeA, a.edge) == bit(codeB, b.edge));
            const bool reversed = a.reversed != b.reversed;
            CHECK(agree(elevation, 1, codeA, a.edge, codeB, b.edge, reversed));
            CHECK(agree(ortho, 0, codeA, a.edge, codeB, b.edge, reversed));
            if (a.face != b.face) ++cubeEdges;
        }
        CHECK(cubeEdges == 12 * o);
    }
}

TEST_CASE("Tiles of a terrain of its own agree at every level") {
    const GradientNoise noise;
    for (int level = 1; level <= 30; ++level) {
        CAPTURE(level);
        const int last = (1 << level) - 1;
        for (int tx : {0, last / 2, last - 1})
            for (int ty : {0, last / 3, last - 1}) {
                const int code = noiseEdgeCode(noise, 0, level, tx, ty);
                const int east = noiseEdgeCode(noise, 0, level, tx + 1, ty);
                const int north = noiseEdgeCode(noise, 0, level, tx, ty + 1);
                CHECK(bit(code, right) == bit(east, left));
                CHECK(bit(code, top) == bit(north, bottom));
            }
    }
}
