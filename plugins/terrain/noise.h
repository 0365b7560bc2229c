// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace terrane {

/// The pseudo random sequence behind every noise of the terrain plugin: a linear congruential
/// generator modulo 2^31, so that the same archive gives the same mountains everywhere
/// (terrain reference 2.9).
class NoiseRandom {
public:
    explicit NoiseRandom(std::uint32_t seed)
        : state_(seed) {}

    /// The next integer, in [0, 2^31).
    std::uint32_t nextInteger() {
        state_ = (1103515245u * state_ + 12345u) & 0x7fffffffu;
        return state_;
    }
    /// The next real, in [0, 1): the upper 24 bits, exact in a float.
    float nextReal() { return static_cast<float>(nextInteger() >> 7) / 16777216.0f; }

private:
    std::uint32_t state_;
};

/// Perlin's lattice gradient noise in the plane, in single precision, with a period of 256 in both
/// coordinates; zero at lattice points. Immutable, so any thread may ask it.
class GradientNoise {
public:
    GradientNoise();

    /// Meant for coordinates from -4096 to 2^22: below, cells are truncated towards zero; above, a
    /// coordinate loses its half. Defined for |x|, |y| < 2^62.
    float operator()(float x, float y) const;
    const std::array<std::uint8_t, 256>& permutation() const { return permutation_; }

private:
    struct Gradient {
        float x, y;
    };
    /// The gradient of a lattice point, both coordinates in [0, 256).
    const Gradient& gradient(int x, int y) const {
        return gradients_[permutation_[(permutation_[x] + y) & 255]];
    }

    std::array<std::uint8_t, 256> permutation_;
    std::array<Gradient, 256> gradients_;
};

/// Which of two kinds of random border each edge of a tile has: bit 0 bottom, 1 right, 2 top,
/// 3 left. Tiles that share an edge get the same bit for it, also across the edges of a cube, so
/// that noise that depends on nothing else has no seams.
///
/// @param face cube face 1 (north) to 6 (south) of a planet, 0 for a terrain of its own
/// @param tx,ty tile coordinates at this level, 0 <= tx,ty < 2^level, level <= 30
int noiseEdgeCode(const GradientNoise& noise, int face, int level, int tx, int ty);

/// How the noise images serve a tile of some edge code: take this layer, and at the texture
/// coordinates (u,v) of the tile sample it at (c[rotation], c[(rotation+1)%4]) with
/// c = (u, v, 1-u, 1-v).
struct NoiseTile {
    int rotation = 0; ///< quarter turns
    int layer = 0;    ///< of the six layers
};
NoiseTile noiseTile(int edgeCode);

} // namespace terrane
