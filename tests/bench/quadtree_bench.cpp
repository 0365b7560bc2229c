// SPDX-License-Identifier: BSD-3-Clause
// What the quadtree costs each frame: dividing it, walking over it, the uniforms of its quads.
#include "flight.h"
#include "terrain/deformation_uniforms.h"

#include <benchmark/benchmark.h>

namespace terrane::bench {
namespace {

/// Quads for each second of the work.
void countQuads(benchmark::State& state, std::int64_t quads) {
    const auto count = static_cast<double>(quads);
    state.counters["quads"] = count / static_cast<double>(state.iterations());
    state.counters["quads/s"] = benchmark::Counter(count, benchmark::Counter::kIsRate);
}

void quadtreeUpdateStill(benchmark::State& state) {
    TerrainNode terrain = mountainTerrain();
    const TerrainView view = flight().front();
    std::int64_t quads = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(terrain.update(view));
        quads += terrain.quads().size();
    }
    countQuads(state, quads);
}
BENCHMARK(quadtreeUpdateStill);

void quadtreeUpdateFlying(benchmark::State& state) {
    TerrainNode terrain = mountainTerrain();
    const std::vector<TerrainView> views = flight();
    std::size_t i = 0;
    std::int64_t quads = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(terrain.update(views[i++ % views.size()]));
        quads += terrain.quads().size();
    }
    countQuads(state, quads);
}
BENCHMARK(quadtreeUpdateFlying);

void quadtreeTraversal(benchmark::State& state) {
    TerrainNode terrain = mountainTerrain();
    terrain.update(flight().front());
    std::int64_t quads = 0;
    for (auto _ : state) {
        terrain.forEachLeaf([&](const TerrainQuad& quad) { quads += quad.isVisible(); });
    }
    countQuads(state, quads);
}
BENCHMARK(quadtreeTraversal);

void uniforms(benchmark::State& state, const QuadUniformNeeds& needs) {
    TerrainNode terrain = mountainTerrain();
    terrain.update(flight().front());
    std::int64_t quads = 0;
    for (auto _ : state) {
        terrain.forEachLeaf([&](const TerrainQuad& quad) {
            if (!quad.isVisible()) return;
            benchmark::DoNotOptimize(
                quadUniforms(terrain.deformation(), terrain.state(), quad, needs));
            ++quads;
        });
    }
    countQuads(state, quads);
}
BENCHMARK_CAPTURE(uniforms, all, QuadUniformNeeds{});
BENCHMARK_CAPTURE(uniforms, ofTheMountains, QuadUniformNeeds{false, false, false});

} // namespace
} // namespace terrane::bench
