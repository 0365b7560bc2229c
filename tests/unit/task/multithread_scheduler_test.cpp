// SPDX-License-Identifier: BSD-3-Clause
#include "task/multithread_scheduler.h"

#include "test_task.h"

#include <doctest/doctest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace terrane;

namespace {

using Options = MultithreadScheduler::Options;
using Names = std::vector<std::string>;

/// Tasks that write down their names in the order in which they run.
struct Log {
    std::mutex mutex;
    Names names;

    void write(std::string name) {
        const std::lock_guard lock(mutex);
        names.push_back(std::move(name));
    }
    Names take() { return std::exchange(names, {}); }
    std::shared_ptr<TestTask> task(Task::Kind kind, std::string name,
                                   unsigned deadline = Task::kImmediate) {
        return std::make_shared<TestTask>(
            kind, [this, name] { return write(name), true; }, "Logged", deadline);
    }
    std::shared_ptr<TestTask> cpu(std::string name, unsigned deadline = Task::kImmediate) {
        return task(Task::Kind::cpu, std::move(name), deadline);
    }
    std::shared_ptr<TestTask> gpu(std::string name, unsigned deadline = Task::kImmediate) {
        return task(Task::Kind::gpu, std::move(name), deadline);
    }
    std::shared_ptr<TestTask> gpuIn(const int& context, std::string name) {
        auto made = gpu(name);
        made->sharedContext = &context;
        made->onBegin = [this, name] { write("begin " + name); };
        made->onEnd = [this, name] { write("end " + name); };
        return made;
    }
};

/// The workers that each row of a table is run with.
template <class Test>
void withWorkers(Test test) {
    for (const unsigned workers : {0u, 1u, 2u, 4u}) {
        CAPTURE(workers);
        test(workers);
    }
}

} // namespace

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

TEST_CASE("An exception is reported, and the frame goes on") {
    withWorkers([](unsigned workers) {
        MultithreadScheduler scheduler(Options{.nthreads = workers});
        Log errors, log;
        scheduler.setErrorHandler([&](const Task& task, const std::string& message) {
            errors.write(std::string(task.name()) + ": " + message);
        });
        for (const auto kind : {Task::Kind::cpu, Task::Kind::gpu}) {
            bool broken = true;
            const auto bad = std::make_shared<TestTask>(
                kind,
                [&]() -> bool {
                    if (broken) throw std::runtime_error("no more disk");
                    return true;
                },
                "ReadTile");
            const auto after = log.cpu("after");
            after->addPredecessor(bad);
            TaskGraph graph;
            graph.add(after);
            scheduler.run(graph);
            CHECK(bad->done());
            CHECK(bad->failed());
            CHECK(bad->completionDate() == 0);
            CHECK(after->done());
            CHECK_FALSE(after->failed());
            CHECK(log.take() == Names{"after"});
            CHECK(errors.take() == Names{"ReadTile: no more disk"});
            CHECK(scheduler.statistics().failed == 1);

            broken = false;
            bad->markUndone(Task::Reason::dataChanged);
            graph.clear();
            graph.add(after);
            scheduler.run(graph);
            CHECK_FALSE(bad->failed());
            CHECK(log.take() == Names{"after"});
        }
    });
}

TEST_CASE("What is thrown need not be an exception, nor come from run") {
    MultithreadScheduler scheduler;
    Log errors, log;
    scheduler.setErrorHandler(
        [&](const Task&, const std::string& message) { errors.write(message); });
    const int x = 0;
    TaskGraph graph;
    const auto task = log.gpuIn(x, "x");
    SUBCASE("not an exception") {
        graph.add(cpuTask([]() -> bool { throw 1; }));
        scheduler.run(graph);
        CHECK(errors.take() == Names{"unknown exception"});
    }
    SUBCASE("begin") {
        task->onBegin = [] { throw std::runtime_error("begin"); };
        graph.add(task);
        graph.add(log.gpuIn(x, "x2"));
        scheduler.run(graph);
        CHECK(errors.take() == Names{"begin"});
        CHECK(task->failed());
        CHECK(task->runs == 0);
        CHECK(log.take() == Names{"begin x2", "x2", "end x2"});
    }
    SUBCASE("end") {
        task->onEnd = [] { throw std::runtime_error("end"); };
        graph.add(task);
        scheduler.run(graph);
        CHECK(errors.take() == Names{"end"});
        CHECK(task->done());
    }
}

TEST_CASE("Tasks that wait for each other are reported, and run all the same") {
    struct Tasks {
        std::shared_ptr<TestTask> a = cpuTask({}, "A"), b = gpuTask({}, "B"), c = cpuTask({}, "C");
    };
    struct Row {
        const char* name;
        const char* cycle;
        void (*build)(TaskGraph&, const Tasks&);
    };
    const Row rows[] = {
        {"in a graph", "A -> B -> C -> A",
         [](TaskGraph& graph, const Tasks& t) {
             const auto a = graph.add(t.a), b = graph.add(t.b), c = graph.add(t.c);
             graph.addDependency(b, a);
             graph.addDependency(c, b);
             graph.addDependency(a, c);
         }},
        {"as inputs", "C -> A -> B -> C",
         [](TaskGraph& graph, const Tasks& t) {
             t.a->addPredecessor(t.c);
             t.b->addPredecessor(t.a);
             t.c->addPredecessor(t.b);
             graph.add(t.c);
         }},
        {"of both kinds", "B -> A -> B",
         [](TaskGraph& graph, const Tasks& t) {
             t.b->addPredecessor(t.a);
             const auto b = graph.add(t.b);
             graph.addDependency(graph.add(t.a), b);
             graph.add(t.c);
         }},
        {"with itself", "C -> C",
         [](TaskGraph& graph, const Tasks& t) {
             graph.add(t.a);
             graph.add(t.b);
             graph.addDependency(graph.add(t.c), graph.add(t.c));
         }},
        {"through a join", "(join) -> A -> (join)",
         [](TaskGraph& graph, const Tasks& t) {
             const auto join = graph.join();
             graph.addDependency(graph.add(t.a), join);
             graph.addDependency(join, graph.add(t.a));
             graph.add(t.b);
             graph.add(t.c);
         }},
    };
    withWorkers([&](unsigned workers) {
        MultithreadScheduler scheduler(Options{.nthreads = workers});
        Log errors;
        scheduler.setErrorHandler(
            [&](const Task&, const std::string& message) { errors.write(message); });
        for (const Row& row : rows) {
            CAPTURE(row.name);
            TaskGraph graph;
            const Tasks tasks;
            const auto behind = cpuTask({}, "Behind");
            row.build(graph, tasks);
            graph.addDependency(graph.add(behind), graph.add(tasks.c));
            scheduler.run(graph);
            CHECK(errors.take() == Names{"tasks wait for each other: " + std::string(row.cycle) +
                                         "; the last of these dependencies is ignored"});
            CHECK(scheduler.statistics().cycles == 1);
            for (const auto& task : {tasks.a, tasks.b, tasks.c, behind}) {
                CHECK(task->done());
                CHECK(task->runs == 1);
            }
            for (const auto& task : {tasks.a, tasks.b, tasks.c})
                task->clearPredecessors(); // or they would own each other for ever
        }
    });
}

TEST_CASE("A cycle of future tasks does not fill the queue") {
    MultithreadScheduler scheduler(Options{.prefetchRate = 2, .prefetchQueue = 8});
    const auto a = cpuTask({}, "A", Task::kWhenever), b = cpuTask({}, "B", Task::kWhenever);
    TaskGraph graph;
    graph.addDependency(graph.add(a), graph.add(b));
    graph.addDependency(graph.add(b), graph.add(a));
    scheduler.run(graph);
    CHECK(a->runs == 1);
    CHECK(b->runs == 1);
    CHECK(scheduler.statistics().waiting == 0);
}

TEST_CASE("A graph with cycles only among joins ends") {
    MultithreadScheduler scheduler;
    TaskGraph graph;
    const auto a = graph.join(), b = graph.join();
    graph.addDependency(a, b);
    graph.addDependency(b, a);
    scheduler.run(graph);
    scheduler.waitIdle();
    CHECK(true);
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
