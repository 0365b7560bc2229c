// SPDX-License-Identifier: BSD-3-Clause
#include "plugin_terrain/elevation_oracle.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <glm/glm.hpp>

using namespace terrane;
using terrane::test::ElevationOracle;
using terrane::test::roundedToHalf;

namespace {

struct Row {
    const char* name;
    ElevationOracle::Parameters parameters;
};

std::vector<Row> rows() {
    const std::vector<double> amplitudes{-140, 120, -90, 60, 30, 15};
    return {{"terrain", {29, 12, 0, false, false, amplitudes}},
            {"sea", {29, 12, 0, false, true, amplitudes}},
            {"flipped diagonals", {29, 12, 3, true, false, amplitudes}},
            {"a vertex at each texel", {29, 24, 1, true, true, amplitudes}},
            {"wide cells", {53, 12, 6, false, false, amplitudes}}};
}

} // namespace

TEST_CASE("Numbers are rounded to half floats like GL rounds them") {
    struct Half {
        double value, rounded;
    };
    for (const Half& row :
         {Half{0, 0}, Half{1, 1}, Half{-0.5, -0.5}, Half{0.1, 0.0999755859375},
          Half{1.0 / 3, 0.333251953125}, Half{1 + 1.0 / 2048, 1},
          Half{1 + 3.0 / 2048, 1 + 4.0 / 2048}, Half{0.99999, 1}, Half{-0.430654, -0.4306640625},
          Half{1e-9, 0}, Half{3e-8, std::ldexp(1.0, -24)},
          Half{std::ldexp(1.0, -14), std::ldexp(1.0, -14)}, Half{1234.4, 1234}})
        CHECK(roundedToHalf(row.value) == row.rounded);
}

TEST_CASE("The root tile is the noise alone") {
    for (const Row& row : rows()) {
        CAPTURE(row.name);
        ElevationOracle oracle(row.parameters);
        const ElevationOracle::Tile& root = oracle.tile(0, 0, 0);
        double largest = 0;
        for (int k = 0; k < root.width(); ++k)
            for (int i = 0; i < root.width(); ++i) {
                const auto& texel = root.at(i, k);
                largest = std::max(largest, std::abs(texel.zf));
                CHECK(texel.zc == texel.zf);
                CHECK(texel.zm == (row.parameters.clamp ? std::max(texel.zf, 0.0) : texel.zf));
            }
        CHECK(root.at(2, 2).zf == 0);
        CHECK(largest > 100);
        CHECK(largest <= 140);
    }
}

TEST_CASE("Neighbouring tiles have the same elevations where they overlap") {
    for (const Row& row : rows()) {
        CAPTURE(row.name);
        ElevationOracle oracle(row.parameters);
        const int w = row.parameters.tileSize;
        const int n = w - 5;
        for (int level : {1, 2, 3, 5}) {
            CAPTURE(level);
            const int last = (1 << level) - 1;
            for (int at : {0, last / 2, last - 1}) {
                const auto& tile = oracle.tile(level, at, last / 3);
                const auto& east = oracle.tile(level, at + 1, last / 3);
                const auto& below = oracle.tile(level, last / 3, at);
                const auto& above = oracle.tile(level, last / 3, at + 1);
                for (int t = 0; t < w; ++t) {
                    for (int d = 0; d < 5; ++d) {
                        CHECK(tile.at(n + d, t).zf ==
                              doctest::Approx(east.at(d, t).zf).epsilon(1e-12));
                        CHECK(tile.at(n + d, t).zm ==
                              doctest::Approx(east.at(d, t).zm).epsilon(1e-12));
                        CHECK(below.at(t, n + d).zf ==
                              doctest::Approx(above.at(t, d).zf).epsilon(1e-12));
                    }
                    // Coarse elevations agree on the edge itself, borders of it apart.
                    if (t < 2 || t > n + 2) continue;
                    CHECK(tile.at(n + 2, t).zc == doctest::Approx(east.at(2, t).zc).epsilon(1e-12));
                    CHECK(below.at(t, n + 2).zc ==
                          doctest::Approx(above.at(t, 2).zc).epsilon(1e-12));
                }
            }
        }
    }
}

TEST_CASE("Without noise a level interpolates its parent") {
    for (const Row& row : rows()) {
        CAPTURE(row.name);
        ElevationOracle::Parameters p = row.parameters;
        p.amplitudes = {-140, 120}; // none at level 2
        ElevationOracle oracle(p);
        const int n = p.tileSize - 5;
        for (int tile = 0; tile < 16; ++tile) {
            const int tx = tile % 4;
            const int ty = tile / 4;
            const auto& parent = oracle.tile(1, tx / 2, ty / 2);
            const auto& child = oracle.tile(2, tx, ty);
            const int dx = tx % 2 * n / 2;
            const int dy = ty % 2 * n / 2;
            for (int k = 0; k < p.tileSize; ++k)
                for (int i = 0; i < p.tileSize; ++i) {
                    // Lagrange's cubic through four texels, at the texel's own place.
                    const auto lagrange = [](double t, int node) {
                        double value = 1;
                        for (int other = 0; other < 4; ++other)
                            if (other != node) value *= (t - other) / (node - other);
                        return value;
                    };
                    // The quad's corner is texel 2 in both; half a parent texel for each of ours.
                    const double x = 2 + dx + (i - 2) / 2.0;
                    const double y = 2 + dy + (k - 2) / 2.0;
                    const int x0 = static_cast<int>(std::floor(x)) - 1;
                    const int y0 = static_cast<int>(std::floor(y)) - 1;
                    double expected = 0;
                    for (int b = 0; b < 4; ++b)
                        for (int a = 0; a < 4; ++a) {
                            const double weight = lagrange(x - x0, a) * lagrange(y - y0, b);
                            if (weight != 0) expected += weight * parent.at(x0 + a, y0 + b).zf;
                        }
                    CHECK(child.at(i, k).zf == doctest::Approx(expected).epsilon(1e-10));
                }
        }
    }
}

TEST_CASE("Coarse elevations are those of the parent's triangles") {
    for (const Row& row : rows()) {
        CAPTURE(row.name);
        ElevationOracle oracle(row.parameters);
        const int n = row.parameters.tileSize - 5;
        const int g = n / row.parameters.gridSize;
        const int cells = row.parameters.gridSize;
        for (int tile = 0; tile < 4; ++tile) {
            const auto& parent = oracle.tile(2, 1, 2);
            const int tx = 2 + tile % 2;
            const int ty = 4 + tile / 2;
            const auto& child = oracle.tile(3, tx, ty);
            // At each vertex of the child's mesh, by barycentric interpolation in the parent's.
            for (int row2 = 0; row2 <= cells; ++row2)
                for (int column = 0; column <= cells; ++column) {
                    const double x = column / 2.0 + tile % 2 * cells / 2.0;
                    const double y = row2 / 2.0 + tile / 2 * cells / 2.0;
                    const int cx = std::min(static_cast<int>(x), cells - 1);
                    const int cy = std::min(static_cast<int>(y), cells - 1);
                    const double u = x - cx;
                    const double v = y - cy;
                    const auto z = [&](int a, int b) {
                        return parent.at(2 + g * (cx + a), 2 + g * (cy + b)).zm;
                    };
                    const bool rising =
                        row.parameters.flip && z(0, 1) + z(1, 0) < z(0, 0) + z(1, 1);
                    double expected = 0;
                    if (rising)
                        expected =
                            u > v ? z(0, 0) + u * (z(1, 0) - z(0, 0)) + v * (z(1, 1) - z(1, 0))
                                  : z(0, 0) + v * (z(0, 1) - z(0, 0)) + u * (z(1, 1) - z(0, 1));
                    else
                        expected = u + v < 1
                                       ? z(0, 0) + u * (z(1, 0) - z(0, 0)) + v * (z(0, 1) - z(0, 0))
                                       : z(1, 1) + (1 - u) * (z(0, 1) - z(1, 1)) +
                                             (1 - v) * (z(1, 0) - z(1, 1));
                    CHECK(child.at(2 + g * column, 2 + g * row2).zc ==
                          doctest::Approx(expected).epsilon(1e-10));
                }
        }
    }
}

TEST_CASE("Normals are those of the cross product") {
    ElevationOracle oracle(rows()[1].parameters);
    const auto& tile = oracle.tile(2, 1, 3);
    const int n = tile.width() - 5;
    const double d = 2500.0 / n;
    for (int k = 0; k <= n; ++k)
        for (int i = 0; i <= n; ++i) {
            const auto point = [&](int a, int b) {
                return glm::dvec3((i + a) * d, (k + b) * d, tile.at(i + 2 + a, k + 2 + b).zm);
            };
            const glm::dvec3 normal =
                glm::normalize(glm::cross(point(1, 0) - point(-1, 0), point(0, 1) - point(0, -1)));
            const auto [x, y] = ElevationOracle::normal(tile, i, k, 2500);
            CHECK(x == doctest::Approx(normal.x));
            CHECK(y == doctest::Approx(normal.y));
        }
}
