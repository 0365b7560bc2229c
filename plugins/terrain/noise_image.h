// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace terrane {

constexpr int kNoiseLayers = 6;
/// The edge code that each layer has in its own orientation; quarter turns give all sixteen.
constexpr std::array<int, kNoiseLayers> kNoiseLayerCodes{0, 1, 3, 5, 7, 15};

/// Six square layers of random numbers, one for each combination of edge kinds up to rotation.
/// An edge of either kind looks the same from both sides, so that two tiles whose edge codes agree
/// on an edge agree on all texels around it (terrain reference 2.9). Laid out as GL uploads a 2-D
/// array texture: layer by layer, row by row from the bottom, channels together.
template <class T>
struct NoiseImage {
    int width = 0;
    int channels = 1;
    std::vector<T> values;

    std::size_t index(int column, int row, int layer, int channel = 0) const {
        const auto w = static_cast<std::size_t>(width);
        return ((static_cast<std::size_t>(layer) * w + row) * w + column) * channels + channel;
    }
    T operator()(int column, int row, int layer, int channel = 0) const {
        return values[index(column, row, layer, channel)];
    }
};

/// Noise for elevation tiles: one channel in [-1, 1), meant for an R16F texture. Zero in the
/// corners, where four tiles meet.
/// @param width tile width n + 5, odd: texel 2 lies on the edge, 0 and 1 in the neighbour
NoiseImage<float> makeElevationNoise(int width);

/// Noise for colour tiles: four channels, meant for an RGBA8 texture. 128 in the corners.
/// @param width tile width n + 4: texels 0 and 1 lie in the neighbour, the edge between 1 and 2
NoiseImage<std::uint8_t> makeOrthoNoise(int width);

} // namespace terrane
