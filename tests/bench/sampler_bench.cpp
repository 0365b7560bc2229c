// SPDX-License-Identifier: BSD-3-Clause
// What a frame of the mountains costs beside drawing: samplers that ask for tiles, and find them.
#include "flight.h"
#include "mountains.h"
#include "resource/manager.h"
#include "scene/frame_builder.h"
#include "scene/scene_manager.h"
#include "task/scheduler.h"
#include "terrain/tile_sampler.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace terrane::bench {
namespace {

/// The mountains, whose tiles are made along the first second of a flight.
struct Ground {
    Ground() {
        if (!player) return;
        views.resize(60);
        terrain = share(player->resources()->get<TerrainNode>("groundTerrain"));
        samplers = player->scene()->nodes("object").front()->fieldsOf<TileSampler>();
        for (const TerrainView& view : views) {
            update(view);
            player->scene()->scheduler()->run(graph);
        }
    }

    void update(const TerrainView& view) {
        terrain->update(view);
        updateSamplers();
    }
    void updateSamplers() {
        graph.clear();
        FrameBuilder frame(graph);
        for (TileSampler* sampler : samplers)
            sampler->update(*terrain, *player->scene(), frame);
    }
    void count(benchmark::State& state, std::int64_t quads) const {
        const auto all = static_cast<double>(quads);
        state.counters["quads"] = all / static_cast<double>(state.iterations());
        state.counters["quads/s"] = benchmark::Counter(all, benchmark::Counter::kIsRate);
    }

    std::unique_ptr<Player> player = loadMountains();
    std::shared_ptr<TerrainNode> terrain;
    std::vector<TileSampler*> samplers;
    std::vector<TerrainView> views = flight();
    TaskGraph graph;
};

void samplersStill(benchmark::State& state) {
    Ground ground;
    if (!ground.player) return state.SkipWithError("no mountains");
    std::int64_t quads = 0;
    for (auto _ : state) {
        ground.updateSamplers();
        quads += ground.terrain->quads().size();
    }
    ground.count(state, quads);
}
BENCHMARK(samplersStill);

/// To and fro over tiles that are known, the quadtree included.
void samplersFlying(benchmark::State& state) {
    Ground ground;
    if (!ground.player) return state.SkipWithError("no mountains");
    std::size_t i = 0, step = 1;
    std::int64_t quads = 0;
    for (auto _ : state) {
        if (i + step >= ground.views.size()) step = ~std::size_t{0}; // wraps: one back
        if (i == 0) step = 1;
        i += step;
        ground.update(ground.views[i]);
        quads += ground.terrain->quads().size();
    }
    ground.count(state, quads);
}
BENCHMARK(samplersFlying);

/// Where the tiles of the visible quads are, for all samplers.
void locateTiles(benchmark::State& state) {
    Ground ground;
    if (!ground.player) return state.SkipWithError("no mountains");
    std::int64_t quads = 0;
    for (auto _ : state) {
        ground.terrain->forEachLeaf([&](const TerrainQuad& quad) {
            if (!quad.isVisible()) return;
            ++quads;
            for (const TileSampler* sampler : ground.samplers)
                benchmark::DoNotOptimize(sampler->locate(*ground.terrain, quad));
        });
    }
    ground.count(state, quads);
}
BENCHMARK(locateTiles);

} // namespace
} // namespace terrane::bench
