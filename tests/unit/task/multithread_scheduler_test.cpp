// SPDX-License-Identifier: BSD-3-Clause
#include "task/multithread_scheduler.h"

#include "test_task.h"

#include <doctest/doctest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

using namespace terrane;

using Options = MultithreadScheduler::Options;

TEST_CASE("An empty graph is nothing to do") {
    withWorkers([](unsigned workers) {
        MultithreadScheduler scheduler(Options{.nthreads = workers});
        TaskGraph graph;
        scheduler.run(graph);
        graph.join();
        scheduler.run(graph);
        scheduler.waitIdle();
        CHECK(scheduler.statistics().executed == 0);
    });
}

TEST_CASE("Tasks without an order among them run as they were added") {
    Log log;
    TaskGraph graph;
    MultithreadScheduler scheduler;
    for (const char* name : {"a", "b", "c"})
        graph.add(log.cpu(name));
    graph.add(log.gpu("d"));
    scheduler.run(graph);
    CHECK(log.take() == Names{"a", "b", "c", "d"});
}

TEST_CASE("Dependencies of a graph order its tasks") {
    withWorkers([](unsigned workers) {
        Log log;
        TaskGraph graph;
        MultithreadScheduler scheduler(Options{.nthreads = workers});
        const auto c = graph.add(log.cpu("c")), b = graph.add(log.gpu("b"));
        const auto a = graph.add(log.cpu("a"));
        graph.addDependency(b, a);
        graph.addDependency(c, b);
        graph.addDependency(c, b);  // twice is once
        graph.addDependency(c, {}); // nothing
        graph.addDependency(TaskGraph::Node{}, c);
        scheduler.run(graph);
        CHECK(log.take() == Names{"a", "b", "c"});
    });
}

TEST_CASE("A sequence goes on over tasks that are done") {
    Log log;
    TaskGraph graph;
    MultithreadScheduler scheduler;
    const auto done = log.cpu("done");
    graph.add(done);
    scheduler.run(graph);
    log.take();
    graph.clear();
    const auto last = graph.add(log.cpu("last"));
    TaskGraph::Node node = graph.addAfter(log.cpu("first"), {});
    node = graph.addAfter(done, node);
    graph.addDependency(last, node);
    scheduler.run(graph);
    CHECK(log.take() == Names{"first", "last"});
}

TEST_CASE("A join orders groups") {
    withWorkers([](unsigned workers) {
        Log log;
        TaskGraph graph;
        MultithreadScheduler scheduler(Options{.nthreads = workers});
        const auto join = graph.join(), second = graph.join();
        graph.addDependency(graph.add(log.cpu("z")), second);
        graph.addDependency(second, join);
        for (const char* name : {"a", "b", "c"})
            graph.addDependency(join, graph.add(log.cpu(name)));
        scheduler.run(graph);
        const Names names = log.take();
        REQUIRE(names.size() == 4);
        CHECK(names.back() == "z");
    });
}

TEST_CASE("Earlier deadlines go first, and are inherited by what they wait for") {
    Log log;
    TaskGraph graph;
    // prefetchRate: the caller does them all.
    MultithreadScheduler scheduler(Options{.prefetchRate = 10, .prefetchQueue = 10});
    SUBCASE("among future tasks") {
        graph.add(log.cpu("late", Task::kWhenever));
        graph.add(log.cpu("30", 30));
        graph.add(log.gpu("20", 20));
        graph.add(log.cpu("10", 10));
        graph.add(log.gpu("now"));
        scheduler.run(graph);
        CHECK(log.take() == Names{"now", "10", "20", "30", "late"});
        CHECK(scheduler.statistics().executed == 5);
        CHECK(scheduler.statistics().future == 4);
    }
    SUBCASE("inherited through inputs, dependencies and joins") {
        graph.add(log.cpu("10", 10));
        const auto input = log.cpu("input", Task::kWhenever);
        const auto needed = log.cpu("needed", 5);
        needed->addPredecessor(input);
        const auto join = graph.join();
        graph.addDependency(join, graph.add(log.cpu("earlier", Task::kWhenever)));
        graph.addDependency(graph.add(needed), join);
        scheduler.run(graph);
        CHECK(log.take() == Names{"earlier", "input", "needed", "10"});
    }
    SUBCASE("a queued task that is needed now") {
        const auto first = log.cpu("first", Task::kWhenever);
        const auto input = log.cpu("input", Task::kWhenever);
        const auto queued = log.cpu("queued", Task::kWhenever);
        queued->addPredecessor(input);
        CHECK(scheduler.schedule(first));
        CHECK(scheduler.schedule(queued));
        CHECK(scheduler.schedule(queued)); // queued already
        scheduler.reschedule(*queued, Task::Reason::dataNeeded, Task::kImmediate);
        CHECK(queued->deadline() == Task::kImmediate);
        scheduler.run(graph);
        CHECK(log.take() == Names{"input", "queued", "first"});
    }
    SUBCASE("a queued task that a graph waits for") {
        const auto first = log.cpu("first", Task::kWhenever);
        const auto queued = log.cpu("queued", Task::kWhenever);
        scheduler.schedule(first);
        scheduler.schedule(queued);
        const auto draw = log.gpu("draw");
        draw->addPredecessor(queued);
        graph.add(draw);
        scheduler.run(graph);
        CHECK(log.take() == Names{"queued", "draw", "first"});
    }
}

TEST_CASE("GPU tasks of a context run together, between one begin and one end") {
    Log log;
    TaskGraph graph;
    MultithreadScheduler scheduler;
    const int x = 0, y = 0;
    SUBCASE("grouped") {
        graph.add(log.gpuIn(x, "x1"));
        graph.add(log.gpuIn(y, "y1"));
        graph.add(log.gpuIn(x, "x2"));
        graph.add(log.gpuIn(y, "y2"));
        scheduler.run(graph);
        CHECK(log.take() ==
              Names{"begin x1", "x1", "x2", "end x2", "begin y1", "y1", "y2", "end y2"});
        CHECK(scheduler.statistics().contextSwitches == 2);
    }
    SUBCASE("without a context first, then with; without costs nothing") {
        graph.add(log.gpuIn(x, "x1"));
        graph.add(log.gpu("plain"));
        scheduler.run(graph);
        CHECK(log.take() == Names{"plain", "begin x1", "x1", "end x1"});
    }
    SUBCASE("a context that is open goes first; others close it, CPU tasks don't") {
        const auto x1 = graph.add(log.gpuIn(x, "x1"));
        const auto x2 = log.gpuIn(x, "x2");
        const auto plain = log.gpu("plain");
        const auto cpu = graph.add(log.cpu("cpu"));
        graph.addDependency(cpu, x1);
        graph.addDependency(graph.add(plain), cpu);
        graph.addDependency(graph.add(x2), cpu);
        graph.addDependency(graph.add(log.gpuIn(x, "x3")), graph.find(*plain));
        scheduler.run(graph);
        CHECK(log.take() ==
              Names{"begin x1", "x1", "cpu", "x2", "end x2", "plain", "begin x3", "x3", "end x3"});
    }
    SUBCASE("a skipped task opens nothing") {
        const auto task = log.gpuIn(x, "x1");
        graph.add(task);
        scheduler.run(graph);
        log.take();
        task->markUndone(Task::Reason::dependencyChanged);
        graph.clear();
        graph.add(task);
        scheduler.run(graph);
        CHECK(log.take().empty());
        CHECK(task->done());
    }
}

TEST_CASE("GPU tasks run on the calling thread only") {
    withWorkers([](unsigned workers) {
        MultithreadScheduler scheduler(Options{.nthreads = workers});
        const auto owner = std::this_thread::get_id();
        std::atomic<int> elsewhere = 0;
        TaskGraph graph;
        for (int i = 0; i < 50; ++i) {
            const auto cpu = graph.add(cpuTask());
            const auto gpu = graph.add(
                gpuTask([&] { return elsewhere += std::this_thread::get_id() != owner, true; }));
            graph.addDependency(i % 2 ? gpu : cpu, i % 2 ? cpu : gpu);
        }
        scheduler.run(graph);
        CHECK(elsewhere == 0);
        CHECK(scheduler.statistics().executed == 100);
    });
}

TEST_CASE("Workers help with the CPU tasks of the frame") {
    // Each task waits for the others: that ends only if they run at the same time.
    MultithreadScheduler scheduler(Options{.nthreads = 2});
    std::atomic<int> arrived = 0;
    const auto meet = [&] {
        ++arrived;
        while (arrived < 3)
            std::this_thread::yield();
        return true;
    };
    TaskGraph graph;
    graph.add(cpuTask(meet));
    graph.add(gpuTask(meet));
    graph.add(cpuTask(meet));
    scheduler.run(graph);
    CHECK(scheduler.statistics().onWorkers == 2);
}

TEST_CASE("A task that is marked while it runs runs once more") {
    MultithreadScheduler scheduler(Options{.nthreads = 1});
    std::atomic<bool> started = false, goOn = false;
    const auto task = cpuTask(
        [&] {
            started = true;
            while (!goOn)
                std::this_thread::yield();
            return true;
        },
        "Tile", Task::kWhenever);
    const auto after = gpuTask();
    after->addPredecessor(task);
    REQUIRE(scheduler.schedule(task));
    while (!started)
        std::this_thread::yield();
    TaskGraph graph;
    SUBCASE("data changed") {
        scheduler.reschedule(*task, Task::Reason::dataChanged);
        SUBCASE("asked for later") {
            goOn = true;
            scheduler.waitIdle();
            CHECK_FALSE(task->done());
        }
        SUBCASE("asked for at once") {
            graph.add(after);
            goOn = true;
        }
        graph.add(after);
        scheduler.run(graph);
        CHECK(task->runs == 2);
    }
    SUBCASE("data needed: it is about to be there") {
        scheduler.reschedule(*task, Task::Reason::dataNeeded, Task::kImmediate);
        graph.add(after);
        goOn = true;
        scheduler.run(graph);
        CHECK(task->runs == 1);
    }
    CHECK(task->done());
    CHECK(after->done());
    CHECK(after->runs == 1);
}

TEST_CASE("The observer is told of each run: task, thread, start before end") {
    withWorkers([](unsigned workers) {
        MultithreadScheduler scheduler(Options{.nthreads = workers});
        std::mutex mutex;
        std::set<const Task*> seen;
        scheduler.setObserver([&](const TaskRun& run) {
            const std::lock_guard lock(mutex);
            seen.insert(&run.task);
            CHECK(run.start <= run.end);
            CHECK(run.thread <= workers);
            CHECK(run.changed != run.failed);
        });
        TaskGraph graph;
        for (int i = 0; i < 20; ++i)
            graph.add(cpuTask([i]() -> bool {
                if (i == 3) throw std::runtime_error("three");
                return true;
            }));
        scheduler.run(graph);
        CHECK(seen.size() == 20);
        scheduler.setObserver({});
        graph.clear();
        graph.add(cpuTask());
        scheduler.run(graph);
        CHECK(seen.size() == 20);
    });
}
