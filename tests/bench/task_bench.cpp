// SPDX-License-Identifier: BSD-3-Clause
// What the task graph of a frame costs, with tasks that do nothing.
#include "task/multithread_scheduler.h"
#include "task/task_graph.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

namespace terrane::bench {
namespace {

class Nothing : public Task {
public:
    using Task::Task;
    bool run() override { return true; }
};

using Tasks = std::vector<std::shared_ptr<Nothing>>;

/// The tiles of a view: each made from the one of its parent.
Tasks tiles(int count, Task::Kind kind) {
    Tasks tasks;
    for (int i = 0; i < count; ++i) {
        tasks.push_back(std::make_shared<Nothing>(kind, "Tile"));
        if (i > 0) tasks.back()->addPredecessor(tasks[static_cast<std::size_t>(i - 1) / 4]);
    }
    return tasks;
}

/// Five tasks of a frame, and `tiles` ready ones that it may need.
void frameWithReadyTiles(benchmark::State& state) {
    MultithreadScheduler scheduler;
    const Tasks ready = tiles(static_cast<int>(state.range(0)), Task::Kind::gpu);
    Tasks draws;
    for (int i = 0; i < 5; ++i) {
        draws.push_back(std::make_shared<Nothing>(Task::Kind::gpu, "Draw"));
        draws.back()->setEveryFrame(true);
    }
    TaskGraph graph;
    for (auto _ : state) {
        graph.clear();
        for (const auto& tile : ready)
            graph.add(tile);
        TaskGraph::Node last;
        for (const auto& draw : draws)
            last = graph.addAfter(draw, last);
        scheduler.run(graph);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ready.size() + 5));
}
BENCHMARK(frameWithReadyTiles)->Arg(0)->Arg(500)->UseRealTime();

/// A frame in which all tiles have to be made; with that many workers.
void frameWithNewTiles(benchmark::State& state) {
    MultithreadScheduler scheduler({.nthreads = static_cast<unsigned>(state.range(0))});
    const Tasks made = tiles(500, Task::Kind::cpu);
    TaskGraph graph;
    for (auto _ : state) {
        for (const auto& tile : made)
            tile->rearm();
        graph.clear();
        graph.add(made.back());
        for (const auto& tile : made)
            graph.add(tile);
        scheduler.run(graph);
    }
    state.SetItemsProcessed(state.iterations() * 500);
}
BENCHMARK(frameWithNewTiles)->Arg(0)->Arg(1)->Arg(2)->UseRealTime();

} // namespace
} // namespace terrane::bench
