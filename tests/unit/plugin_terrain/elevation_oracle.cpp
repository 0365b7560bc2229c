// SPDX-License-Identifier: BSD-3-Clause
#include "plugin_terrain/elevation_oracle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace terrane::test {

namespace {

// The border: texel 2 lies on the edge of the quad.
constexpr int kBorder = 2;

int floorDivide(int a, int b) {
    return static_cast<int>(std::floor(static_cast<double>(a) / b));
}

// The child's texels lie on and between the parent's: even ones take the parent's second of four,
// odd ones the cubic through all four, half way between the middle two.
std::array<double, 4> weights(int texel) {
    if (texel % 2 == 0) return {0, 1, 0, 0};
    return {-1.0 / 16, 9.0 / 16, 9.0 / 16, -1.0 / 16};
}

} // namespace

double roundedToHalf(double value) {
    if (value == 0) return value;
    // 11 significant bits, and no bit below 2^-24.
    int exponent = 0;
    std::frexp(value, &exponent);
    const double unit = std::ldexp(1.0, std::max(exponent - 11, -24));
    return std::nearbyint(value / unit) * unit;
}

const ElevationOracle::Texel& ElevationOracle::Tile::clamped(int i, int k) const {
    return at(std::clamp(i, 0, width_ - 1), std::clamp(k, 0, width_ - 1));
}

ElevationOracle::ElevationOracle(Parameters parameters)
    : parameters_(std::move(parameters))
    , image_(makeElevationNoise(parameters_.tileSize)) {
    const int n = parameters_.tileSize - 5;
    assert(n > 0 && n % 2 == 0 && n % parameters_.gridSize == 0 && parameters_.gridSize % 2 == 0);
    static_cast<void>(n);
}

const ElevationOracle::Tile& ElevationOracle::tile(int level, int tx, int ty) {
    const std::array<int, 3> key{level, tx, ty};
    if (const auto found = tiles_.find(key); found != tiles_.end()) return found->second;

    const int w = parameters_.tileSize;
    const int n = w - 5;
    const Tile* const parent = level > 0 ? &tile(level - 1, tx / 2, ty / 2) : nullptr;
    const int dx = tx % 2 * n / 2;
    const int dy = ty % 2 * n / 2;
    Tile result(w);
    for (int k = 0; k < w; ++k)
        for (int i = 0; i < w; ++i) {
            Texel& texel = result.at(i, k);
            texel.zf = noise(level, tx, ty, i, k);
            if (parent) {
                // Kept apart from i and k, whose parity chooses the weights.
                const int pi = i / 2 + dx;
                const int pk = k / 2 + dy;
                const std::array<double, 4> wi = weights(i);
                const std::array<double, 4> wk = weights(k);
                for (int b = 0; b < 4; ++b)
                    for (int a = 0; a < 4; ++a)
                        if (wi[a] != 0 && wk[b] != 0)
                            texel.zf += wi[a] * wk[b] * parent->at(pi + a, pk + b).zf;
            }
            texel.zm = parameters_.clamp ? std::max(texel.zf, 0.0) : texel.zf;
            texel.zc = parent ? coarse(*parent, dx, dy, i, k) : texel.zf;
        }
    return tiles_.emplace(key, std::move(result)).first->second;
}

double ElevationOracle::noise(int level, int tx, int ty, int i, int k) const {
    if (level >= static_cast<int>(parameters_.amplitudes.size())) return 0;
    const NoiseTile use = noiseTile(noiseEdgeCode(gradients_, parameters_.face, level, tx, ty));
    // (u, v, 1-u, 1-v) in texels: a quarter turn takes the next component.
    const int last = parameters_.tileSize - 1;
    const std::array<int, 4> c{i, k, last - i, last - k};
    const double value = image_(c[use.rotation], c[(use.rotation + 1) % 4], use.layer);
    // Shaders get the amplitude as a float.
    const double amplitude = static_cast<float>(parameters_.amplitudes[level]);
    return std::abs(amplitude) * roundedToHalf(value);
}

// zc: what the coarser mesh shows at a texel, on the edges of its triangles.
double ElevationOracle::coarse(const Tile& parent, int dx, int dy, int i, int k) const {
    const int g = (parameters_.tileSize - 5) / parameters_.gridSize; // texels of a mesh cell
    const int x = i - kBorder;
    const int y = k - kBorder;
    const auto vertex = [&](int column, int row) {
        return parent.clamped(kBorder + g * column + dx, kBorder + g * row + dy).zm;
    };
    // floor(x/2g) and floor(x/2g + 1/2)
    const int x0 = floorDivide(x, 2 * g), x1 = floorDivide(x + g, 2 * g);
    const int y0 = floorDivide(y, 2 * g), y1 = floorDivide(y + g, 2 * g);
    // On a diagonal, which runs from the upper left to the lower right.
    const double falling = (vertex(x1, y0) + vertex(x0, y1)) / 2;
    const auto isOddMultiple = [g](int v) { return v - 2 * g * floorDivide(v, 2 * g) == g; };
    const bool middleOfCell = isOddMultiple(x) && isOddMultiple(y);
    if (!parameters_.flip || !middleOfCell) return falling;
    const double rising = (vertex(x0, y0) + vertex(x0 + 1, y0 + 1)) / 2;
    return std::max(falling, rising);
}

std::array<double, 2> ElevationOracle::normal(const Tile& tile, int i, int k, double quadSize) {
    const double metresPerTexel = quadSize / (tile.width() - 5);
    const int x = i + kBorder;
    const int y = k + kBorder;
    // The cross product of (2d, 0, east) and (0, 2d, north), divided by 2d.
    const double east = tile.at(x + 1, y).zm - tile.at(x - 1, y).zm;
    const double north = tile.at(x, y + 1).zm - tile.at(x, y - 1).zm;
    const double up = 2 * metresPerTexel;
    const double length = std::sqrt(east * east + north * north + up * up);
    return {-east / length, -north / length};
}

} // namespace terrane::test
