// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/noise.h"
#include "plugins/terrain/noise_image.h"

#include <benchmark/benchmark.h>

namespace terrane::bench {
namespace {

void gradientNoise(benchmark::State& state) {
    const GradientNoise noise;
    float x = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(noise(x += 0.37F, 17.5F));
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(gradientNoise);

/// Once for each tile that is made.
void edgeCodeOfTile(benchmark::State& state) {
    const GradientNoise noise;
    int tile = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(noiseEdgeCode(noise, 0, 10, tile, 511));
        tile = (tile + 1) % 1024;
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(edgeCodeOfTile);

/// Once for each width of tiles, at start.
void elevationNoiseImage(benchmark::State& state) {
    const auto width = static_cast<int>(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(makeElevationNoise(width));
    state.SetItemsProcessed(state.iterations() * width * width * kNoiseLayers);
}
BENCHMARK(elevationNoiseImage)->Arg(29)->Arg(101)->Arg(197);

} // namespace
} // namespace terrane::bench
