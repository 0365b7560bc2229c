// SPDX-License-Identifier: BSD-3-Clause
#include "task/multithread_scheduler.h"

#include "test_task.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

using namespace terrane;

using Options = MultithreadScheduler::Options;

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
