// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plugins/terrain/noise.h"
#include "plugins/terrain/noise_image.h"

#include <array>
#include <map>
#include <vector>

namespace terrane::test {

/// Elevation tiles of a fractal terrain, computed on the CPU in double precision by the formulas of
/// the terrain reference 2.4, as a judge of what elevationProducer and its shaders make. Shares no
/// code with them but the noise (noise.h, noise_image.h), which has tests of its own; shaders see
/// it rounded to half floats, and so does the oracle.
class ElevationOracle {
public:
    struct Parameters {
        int tileSize = 101; ///< w = n + 5, texels with borders; n even
        int gridSize = 24;  ///< even, divides n
        int face = 0;
        bool flip = false;              ///< diagonals of the mesh follow the ridges
        bool clamp = false;             ///< zm = max(zf, 0), like the sea; else zm = zf
        std::vector<double> amplitudes; ///< of the noise, by level; 0 beyond
    };
    struct Texel {
        double zf = 0; ///< raw elevation, the sum of all levels
        double zc = 0; ///< elevation that the parent's mesh shows here
        double zm = 0; ///< elevation of the mesh
    };
    /// Texels row by row from the bottom; (2,2) is the lower left corner of the quad.
    class Tile {
    public:
        explicit Tile(int width)
            : width_(width)
            , texels_(static_cast<std::size_t>(width) * width) {}

        int width() const { return width_; }
        Texel& at(int i, int k) { return texels_[static_cast<std::size_t>(k) * width_ + i]; }
        const Texel& at(int i, int k) const {
            return texels_[static_cast<std::size_t>(k) * width_ + i];
        }
        /// Outside texels are those at the edge, as a sampler that clamps sees them.
        const Texel& clamped(int i, int k) const;

    private:
        int width_;
        std::vector<Texel> texels_;
    };

    explicit ElevationOracle(Parameters parameters);

    /// Made with all its ancestors when first asked for.
    const Tile& tile(int level, int tx, int ty);

    /// x and y of the unit normal at a texel of the quad, i and k from 0 to n, from the mesh
    /// elevations of the four neighbours (terrain reference 2.6, flat terrain).
    /// @param quadSize edge of the quad, metres
    static std::array<double, 2> normal(const Tile& tile, int i, int k, double quadSize);

private:
    double noise(int level, int tx, int ty, int i, int k) const;
    double coarse(const Tile& parent, int dx, int dy, int i, int k) const;

    Parameters parameters_;
    GradientNoise gradients_;
    NoiseImage<float> image_;
    std::map<std::array<int, 3>, Tile> tiles_;
};

/// The nearest number that a half float holds, ties to even, as GL stores floats in R16F. Without
/// overflow: |value| < 65504.
double roundedToHalf(double value);

} // namespace terrane::test
