// SPDX-License-Identifier: BSD-3-Clause
#include "task/multithread_scheduler.h"

#include "test_task.h"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>
#include <vector>

using namespace terrane;

using Options = MultithreadScheduler::Options;

TEST_CASE("run() leaves the future tasks of a graph queued") {
    Log log;
    TaskGraph graph;
    MultithreadScheduler scheduler;
    graph.add(log.cpu("later", 7));
    graph.add(log.cpu("now"));
    scheduler.run(graph);
    CHECK(log.take() == Names{"now"});
    CHECK(scheduler.statistics().waiting == 1);
    SUBCASE("until idle") {
        scheduler.waitIdle();
    }
    SUBCASE("until they are needed") {
        const auto& later = graph.members()[0].task;
        later->setDeadline(0);
        scheduler.run(graph);
        CHECK(scheduler.statistics().waiting == 0);
    }
    CHECK(log.take() == Names{"later"});
}

TEST_CASE("Prefetch is supported as the options say") {
    struct Row {
        const char* name;
        Options options;
        bool cpu, gpu;
    };
    for (const Row& row : {
             Row{"nothing", {}, false, false},
             Row{"workers", {.nthreads = 1}, true, false},
             Row{"a queue alone", {.prefetchQueue = 8}, false, false},
             Row{"prefetch rate", {.prefetchRate = 1, .prefetchQueue = 8}, true, true},
             Row{"frame rate", {.fps = 1000, .prefetchQueue = 8}, true, true},
             Row{"no queue", {.prefetchRate = 1}, false, false},
             Row{"workers, no queue", {.nthreads = 1, .prefetchRate = 1}, true, false},
         }) {
        CAPTURE(row.name);
        MultithreadScheduler scheduler(row.options);
        CHECK(scheduler.supportsPrefetch(Task::Kind::cpu) == row.cpu);
        CHECK(scheduler.supportsPrefetch(Task::Kind::gpu) == row.gpu);
    }
}

TEST_CASE("The prefetch queue has a limit, and each frame does its share") {
    MultithreadScheduler scheduler(Options{.prefetchRate = 2, .prefetchQueue = 5});
    std::vector<std::shared_ptr<TestTask>> tasks;
    for (int i = 0; i < 5; ++i) {
        CHECK(scheduler.supportsPrefetch(Task::Kind::gpu));
        tasks.push_back(gpuTask({}, "Tile", Task::kWhenever));
        CHECK(scheduler.schedule(tasks.back()));
    }
    CHECK_FALSE(scheduler.supportsPrefetch(Task::Kind::gpu));
    CHECK_FALSE(scheduler.supportsPrefetch(Task::Kind::cpu));
    const auto refused = gpuTask({}, "Tile", Task::kWhenever);
    CHECK_FALSE(scheduler.schedule(refused));
    const TaskGraph empty;
    for (const unsigned left : {3u, 1u, 0u, 0u}) {
        scheduler.run(empty);
        CHECK(scheduler.statistics().waiting == left);
    }
    CHECK(refused->runs == 0);
    for (const auto& task : tasks)
        CHECK(task->runs == 1);
}

TEST_CASE("A CPU task is not queued for the workers when an input needs the GPU") {
    MultithreadScheduler scheduler(Options{.nthreads = 1});
    const auto input = gpuTask({}, "Input", Task::kWhenever);
    const auto task = cpuTask({}, "Tile", Task::kWhenever);
    task->addPredecessor(input);
    CHECK_FALSE(scheduler.schedule(task));
    input->clearPredecessors();
    TaskGraph graph;
    input->setDeadline(0);
    graph.add(input);
    scheduler.run(graph);
    CHECK(scheduler.schedule(task));
    scheduler.waitIdle();
    CHECK(task->runs == 1);
}

TEST_CASE("A queued task is done in the frame that repeats its input, which ended undone before") {
    MultithreadScheduler scheduler({.prefetchRate = 1, .prefetchQueue = 10});
    TestTask* self = nullptr;
    const auto input = cpuTask(
        [&] {
            if (self->runs == 1) self->markUndone(Task::Reason::dependencyChanged);
            return true;
        },
        "Input", Task::kWhenever);
    self = input.get();
    const auto task = cpuTask({}, "Task", Task::kWhenever);
    task->addPredecessor(input);
    REQUIRE(scheduler.schedule(task));
    TaskGraph graph;
    scheduler.run(graph); // its share of the queue: the input
    REQUIRE(input->runs == 1);
    REQUIRE_FALSE(input->done());

    task->setDeadline(Task::kImmediate);
    graph.add(task);
    scheduler.run(graph);
    CHECK(input->done());
    CHECK(task->runs == 1);
    CHECK(task->done());
}

TEST_CASE("Queued tasks are dropped when the scheduler goes, and another may run them") {
    const auto task = cpuTask({}, "Tile", Task::kWhenever);
    SUBCASE("destroyed") {
        MultithreadScheduler scheduler(Options{.prefetchRate = 1, .prefetchQueue = 4});
        scheduler.schedule(task);
    }
    SUBCASE("dropped") {
        MultithreadScheduler scheduler(Options{.prefetchRate = 1, .prefetchQueue = 4});
        scheduler.schedule(task);
        scheduler.drop();
        CHECK(scheduler.supportsPrefetch(Task::Kind::gpu));
        scheduler.waitIdle();
    }
    CHECK(task->runs == 0);
    CHECK_FALSE(task->done());
    MultithreadScheduler other;
    TaskGraph graph;
    graph.add(task);
    other.run(graph);
    other.waitIdle();
    CHECK(task->runs == 1);
}

TEST_CASE("Shutting down with work in the queue is clean") {
    for (int repeat = 0; repeat < 50; ++repeat) {
        MultithreadScheduler scheduler(Options{.nthreads = 4});
        for (int i = 0; i < repeat; ++i)
            scheduler.schedule(cpuTask({}, "Tile", Task::kWhenever));
    }
    CHECK(true);
}

TEST_CASE("Tasks are released on the owner thread") {
    std::atomic<int> elsewhere = 0, released = 0;
    const auto owner = std::this_thread::get_id();
    struct Sentinel {
        std::function<void()> atEnd;
        ~Sentinel() { atEnd(); }
    };
    {
        MultithreadScheduler scheduler(Options{.nthreads = 2});
        for (int i = 0; i < 100; ++i) {
            auto sentinel = std::make_shared<Sentinel>();
            sentinel->atEnd = [&] {
                ++released;
                elsewhere += std::this_thread::get_id() != owner;
            };
            scheduler.schedule(cpuTask([sentinel] { return true; }, "Tile", Task::kWhenever));
        }
        scheduler.waitIdle();
    }
    CHECK(released == 100);
    CHECK(elsewhere == 0);
}

TEST_CASE("With a frame rate the future tasks that fit are run") {
    MultithreadScheduler scheduler(Options{.fps = 50, .prefetchQueue = 100});
    std::vector<std::shared_ptr<TestTask>> tasks;
    for (int i = 0; i < 10; ++i) {
        tasks.push_back(cpuTask({}, "Tile", Task::kWhenever));
        scheduler.schedule(tasks.back());
    }
    const TaskGraph empty;
    scheduler.run(empty); // no frame before: nothing is known about the time there is
    CHECK(scheduler.statistics().waiting == 10);
    for (int frame = 0; frame < 100 && scheduler.statistics().waiting > 0; ++frame)
        scheduler.run(empty);
    CHECK(scheduler.statistics().waiting == 0);
}

TEST_CASE("Expected durations need samples, and leave out the extremes") {
    DurationTable table;
    for (std::size_t i = 0; i + 1 < DurationTable::kSamples; ++i)
        table.record("Tile", 2, 4.0);
    CHECK(table.expected("Tile", 1) == 0);
    table.record("Tile", 1, 1000.0);
    CHECK(table.expected("Tile", 3) == doctest::Approx(6.0));
    CHECK(table.expected("Other", 1) == 0);
    DurationTable spread; // samples 1, 3 without the extremes: mean 2, sigma 1
    spread.record("Tile", 1, 0.0);
    spread.record("Tile", 1, 9.0);
    for (std::size_t i = 0; i < DurationTable::kSamples / 2; ++i) {
        spread.record("Tile", 1, 1.0);
        spread.record("Tile", 1, 3.0);
    }
    CHECK(spread.expected("Tile", 1) == doctest::Approx(4.0));
}
