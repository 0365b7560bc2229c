// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/noise.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace terrane {

namespace {

// All numbers below are those of the terrain reference 2.9; archives depend on them.
constexpr std::uint32_t kLatticeSeed = 12345;
constexpr float kLatticeOffset = 4096; // makes coordinates positive

float fade(float t) {
    return t * t * (3 - 2 * t);
}

float mix(float a, float b, float t) {
    return a + t * (b - a);
}

// Where the middle of each edge of a tile lies on the noise plane.
struct EdgeMiddles {
    std::array<float, 2> bottom, right, top, left;
};

// A whole number of lattice cells, and the same plus a half.
float at(std::int64_t cells) {
    return static_cast<float>(cells);
}
float mid(std::int64_t cells) {
    return static_cast<float>(cells) + 0.5f;
}

// Faces 2 to 5 form a band around the equator, 4 faces long; face 0 lies on the band as well.
EdgeMiddles bandMiddles(int face, std::int64_t o, std::int64_t tx, std::int64_t ty) {
    const std::int64_t x = tx + o * (face - 2);
    return {
        {mid(x), at(ty)}, {at((x + 1) % (4 * o)), mid(ty)}, {mid(x), at(ty + 1)}, {at(x), mid(ty)}};
}

// The north face stands on the band; only its bottom edge continues it, the others meet the upper
// edges of faces 3, 4 and 5.
EdgeMiddles northMiddles(std::int64_t o, std::int64_t tx, std::int64_t ty) {
    EdgeMiddles middles{{mid(tx), at(ty + o)},
                        {at(tx + 1), mid(ty + o)},
                        {mid(tx), at(ty + o + 1)},
                        {at(tx), mid(ty + o)}};
    if (tx == o - 1) middles.right = {mid(ty + o), at(o)};
    if (ty == o - 1) middles.top = {mid(3 * o - 1 - tx), at(o)};
    if (tx == 0) middles.left = {mid(4 * o - 1 - ty), at(o)};
    return middles;
}

// The south face hangs below the band at its top edge.
EdgeMiddles southMiddles(std::int64_t o, std::int64_t tx, std::int64_t ty) {
    EdgeMiddles middles{{mid(tx), at(ty - o)},
                        {at(tx + 1), mid(ty - o)},
                        {mid(tx), at(ty - o + 1)},
                        {at(tx), mid(ty - o)}};
    if (ty == 0) middles.bottom = {mid(3 * o - 1 - tx), at(0)};
    if (tx == o - 1) middles.right = {mid(2 * o - 1 - ty), at(0)};
    if (tx == 0) middles.left = {mid(3 * o + ty), at(0)};
    return middles;
}

} // namespace

GradientNoise::GradientNoise() {
    NoiseRandom random(kLatticeSeed);
    const auto component = [&random] {
        return static_cast<float>(static_cast<int>(random.nextInteger() % 512) - 256) / 256.0f;
    };
    for (int i = 0; i < 256; ++i) {
        permutation_[i] = static_cast<std::uint8_t>(i);
        component(); // a gradient on the line, unused
        const float x = component();
        const float y = component();
        const float length = std::sqrt(x * x + y * y);
        gradients_[i] = {x / length, y / length};
        for (int k = 0; k < 3; ++k)
            component(); // a gradient in space, unused
    }
    for (int i = 255; i > 0; --i)
        std::swap(permutation_[i], permutation_[random.nextInteger() % 256]);
}

float GradientNoise::operator()(float x, float y) const {
    const float shiftedX = x + kLatticeOffset;
    const float shiftedY = y + kLatticeOffset;
    const auto cellX = static_cast<std::int64_t>(shiftedX);
    const auto cellY = static_cast<std::int64_t>(shiftedY);
    const float fx = shiftedX - static_cast<float>(cellX);
    const float fy = shiftedY - static_cast<float>(cellY);

    const auto corner = [&](int dx, int dy) {
        const Gradient& g =
            gradient(static_cast<int>((cellX + dx) & 255), static_cast<int>((cellY + dy) & 255));
        return g.x * (fx - static_cast<float>(dx)) + g.y * (fy - static_cast<float>(dy));
    };
    const float bottom = mix(corner(0, 0), corner(1, 0), fade(fx));
    const float top = mix(corner(0, 1), corner(1, 1), fade(fx));
    return mix(bottom, top, fade(fy));
}

int noiseEdgeCode(const GradientNoise& noise, int face, int level, int tx, int ty) {
    assert(face >= 0 && face <= 6 && "noiseEdgeCode: face must be 0 to 6");
    assert(level >= 0 && level <= 30 && "noiseEdgeCode: level must be 0 to 30");
    const std::int64_t o = std::int64_t{1} << level;
    assert(tx >= 0 && tx < o && ty >= 0 && ty < o && "noiseEdgeCode: no such tile");
    const EdgeMiddles middles = face == 1   ? northMiddles(o, tx, ty)
                                : face == 6 ? southMiddles(o, tx, ty)
                                            : bandMiddles(face, o, tx, ty);
    const auto bit = [&noise](const std::array<float, 2>& p) { return noise(p[0], p[1]) > 0; };
    return (bit(middles.bottom) ? 1 : 0) | (bit(middles.right) ? 2 : 0) |
           (bit(middles.top) ? 4 : 0) | (bit(middles.left) ? 8 : 0);
}

NoiseTile noiseTile(int edgeCode) {
    assert(edgeCode >= 0 && edgeCode < 16 && "noiseTile: edge codes are 0 to 15");
    static constexpr std::array<int, 16> kRotations{0, 0, 1, 0, 2, 0, 1, 0, 3, 3, 1, 3, 2, 2, 1, 0};
    static constexpr std::array<int, 16> kLayers{0, 1, 1, 2, 1, 3, 2, 4, 1, 2, 3, 4, 2, 4, 4, 5};
    return {kRotations[edgeCode], kLayers[edgeCode]};
}

} // namespace terrane
