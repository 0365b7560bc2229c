// SPDX-License-Identifier: BSD-3-Clause
#include "task/multithread_scheduler.h"

#include "test_task.h"
#include "tools/terrane/allocation_counter.h"

#include <doctest/doctest.h>

#include <vector>

using namespace terrane;

TEST_CASE("A steady frame allocates nothing") {
    for (const unsigned workers : {0u, 2u}) {
        CAPTURE(workers);
        MultithreadScheduler scheduler({.nthreads = workers});
        const int context = 0;
        // Tiles that are done, some of them looked at again each frame, and draw commands.
        std::vector<std::shared_ptr<TestTask>> tiles, draws;
        for (int i = 0; i < 100; ++i) {
            tiles.push_back(i % 3 ? cpuTask() : gpuTask());
            if (i > 0) tiles.back()->addPredecessor(tiles[static_cast<std::size_t>(i) / 2]);
            draws.push_back(i % 2 ? gpuTask() : cpuTask());
            draws.back()->setEveryFrame(true);
            if (i % 4 == 0) draws.back()->sharedContext = &context;
            draws.back()->addPredecessor(tiles.back());
        }
        TaskGraph graph;
        const auto frame = [&] {
            tiles[99]->markUndone(Task::Reason::dataNeeded);
            graph.clear();
            const TaskGraph::Node join = graph.join();
            TaskGraph::Node last;
            for (std::size_t i = 0; i < draws.size(); ++i) {
                last = graph.addAfter(draws[i], last);
                if (const auto tile = graph.add(tiles[i])) graph.addDependency(join, tile);
            }
            scheduler.run(graph);
        };
        for (int warmUp = 0; warmUp < 3; ++warmUp)
            frame();
        const auto before = countedAllocations();
        for (int i = 0; i < 20; ++i)
            frame();
        CHECK(countedAllocations() == before);
        CHECK(draws[0]->runs == 23);
        CHECK(tiles[99]->runs == 23);
        CHECK(tiles[98]->runs == 1);
    }
}
