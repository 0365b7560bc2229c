// SPDX-License-Identifier: BSD-3-Clause
// What a frame of the mountains costs the CPU beside drawing, in its phases.
#include "flight.h"
#include "mountains.h"
#include "render/program.h"
#include "resource/manager.h"
#include "scene/frame_builder.h"
#include "scene/scene_manager.h"
#include "task/scheduler.h"
#include "terrain/draw_terrain.h"
#include "terrain/tile_sampler.h"

#include <benchmark/benchmark.h>

#include <ctime>
#include <vector>

namespace terrane::bench {
namespace {

/// Seconds that this thread has worked.
double threadTime() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The ground of archives/mountains, and the steps that its tasks take each frame.
class Ground {
public:
    Ground()
        : player_(loadMountains()) {
        if (!player_) return;
        auto& resources = *player_->resources();
        terrain_ = resources.get<TerrainNode>("groundTerrain").shared();
        program_ = resources.get<Program>("weather;groundModule;").shared();
        samplers_ = player_->scene()->nodes("object").front()->fieldsOf<TileSampler>();
        deformation_ = DeformationUniforms(*program_);
        for (const TileSampler* sampler : samplers_)
            samplerUniforms_.emplace_back(*program_, sampler->parameters().uniform);
    }

    explicit operator bool() const { return player_ != nullptr; }

    void update(const TerrainView& view) { terrain_->update(view); }
    void askForTiles() {
        graph_.clear();
        FrameBuilder frame(graph_);
        for (TileSampler* sampler : samplers_)
            sampler->update(*terrain_, *player_->scene(), frame);
    }
    void makeTiles() { player_->scene()->scheduler()->run(graph_); }
    void gather() {
        quads_.clear();
        tiles_.clear();
        const QuadUniformNeeds needs = deformation_.needs();
        terrain_->forEachLeaf([&](const TerrainQuad& quad) {
            if (!quad.isVisible()) return;
            for (const TileSampler* sampler : samplers_)
                tiles_.push_back(sampler->locate(*terrain_, quad));
            quads_.push_back(quadUniforms(terrain_->deformation(), terrain_->state(), quad, needs));
        });
    }
    void setUniforms() {
        deformation_.set(nodeUniforms(terrain_->deformation(), terrain_->state()));
        for (std::size_t i = 0; i < quads_.size(); ++i) {
            deformation_.set(quads_[i]);
            for (std::size_t s = 0; s < samplers_.size(); ++s)
                samplerUniforms_[s].set(tiles_[i * samplers_.size() + s]);
        }
    }
    std::size_t drawn() const { return quads_.size(); }

private:
    std::unique_ptr<Player> player_;
    std::shared_ptr<TerrainNode> terrain_;
    std::shared_ptr<Program> program_;
    std::vector<TileSampler*> samplers_;
    DeformationUniforms deformation_;
    std::vector<SamplerUniforms> samplerUniforms_;
    TaskGraph graph_;
    std::vector<QuadUniforms> quads_;
    std::vector<TileLocation> tiles_;
};

/// Making the tiles is not counted, asking for them is. Counters are microseconds of the processor
/// in a frame, and quads drawn.
void frame(benchmark::State& state, bool flying) {
    Ground ground;
    if (!ground) return state.SkipWithError("no mountains");
    const std::vector<TerrainView> views = flight();
    ground.update(views[0]);
    ground.askForTiles();
    ground.makeTiles();
    double update = 0, tiles = 0, gather = 0, uniforms = 0, drawn = 0;
    std::size_t i = 0;
    for (auto _ : state) {
        const double start = threadTime();
        ground.update(views[flying ? ++i % views.size() : 0]);
        const double updated = threadTime();
        ground.askForTiles();
        const double asked = threadTime();
        ground.makeTiles();
        const double made = threadTime();
        ground.gather();
        const double gathered = threadTime();
        ground.setUniforms();
        const double end = threadTime();
        update += updated - start;
        tiles += asked - updated;
        gather += gathered - made;
        uniforms += end - gathered;
        drawn += static_cast<double>(ground.drawn());
        state.SetIterationTime(asked - start + end - made);
    }
    const auto frames = static_cast<double>(state.iterations());
    state.counters["update_us"] = 1e6 * update / frames;
    state.counters["samplers_us"] = 1e6 * tiles / frames;
    state.counters["gather_us"] = 1e6 * gather / frames;
    state.counters["uniforms_us"] = 1e6 * uniforms / frames;
    state.counters["quads"] = drawn / frames;
}
BENCHMARK_CAPTURE(frame, still, false)->UseManualTime()->Unit(benchmark::kMicrosecond);
// One round.
BENCHMARK_CAPTURE(frame, flying, true)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(418);

} // namespace
} // namespace terrane::bench
