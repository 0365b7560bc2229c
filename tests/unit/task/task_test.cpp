// SPDX-License-Identifier: BSD-3-Clause
#include "task/multithread_scheduler.h"
#include "task/task.h"
#include "task/task_graph.h"

#include "test_task.h"

#include <doctest/doctest.h>

using namespace terrane;

namespace {

void runAlone(Scheduler& scheduler, const std::shared_ptr<Task>& task) {
    TaskGraph graph;
    graph.add(task);
    scheduler.run(graph);
}

} // namespace

TEST_CASE("A new task is undone, older than its inputs, and due now") {
    const auto task = cpuTask();
    CHECK_FALSE(task->done());
    CHECK_FALSE(task->failed());
    CHECK(task->completionDate() == 0);
    CHECK(task->predecessorsDate() == 1);
    CHECK(task->deadline() == Task::kImmediate);
    CHECK(task->complexity() == 1);
}

TEST_CASE("A deadline can only be lowered, and comes back when the task is done") {
    const auto task = cpuTask({}, "Test", Task::kWhenever);
    task->setDeadline(12);
    CHECK(task->deadline() == 12);
    task->setDeadline(13);
    CHECK(task->deadline() == 12);
    task->setDeadline(0);
    MultithreadScheduler scheduler;
    runAlone(scheduler, task);
    CHECK(task->done());
    CHECK(task->deadline() == Task::kWhenever);
}

TEST_CASE("Marking data changed reaches all dependents, data needed none") {
    // a -> b -> d, a -> c -> d, e apart
    MultithreadScheduler scheduler;
    const auto a = cpuTask(), b = cpuTask(), c = cpuTask(), d = cpuTask(), e = cpuTask();
    b->addPredecessor(a);
    c->addPredecessor(a);
    d->addPredecessor(b);
    d->addPredecessor(c);
    const auto runAll = [&] {
        TaskGraph graph;
        graph.add(d);
        graph.add(e);
        scheduler.run(graph);
    };
    runAll();
    for (const auto& task : {a, b, c, d, e}) {
        CHECK(task->done());
        CHECK(task->runs == 1);
    }
    const Task::Date date = d->completionDate();

    SUBCASE("data changed") {
        a->markUndone(Task::Reason::dataChanged);
        CHECK_FALSE(a->done());
        CHECK_FALSE(b->done());
        CHECK_FALSE(c->done());
        CHECK_FALSE(d->done());
        CHECK(e->done());
        CHECK(a->completionDate() == 0);
        CHECK(d->completionDate() == date);
        runAll();
        CHECK(a->runs == 2);
        CHECK(d->runs == 2);
        CHECK(e->runs == 1);
    }
    SUBCASE("data needed") {
        a->markUndone(Task::Reason::dataNeeded);
        CHECK_FALSE(a->done());
        CHECK(b->done());
        CHECK(d->done());
        runAll();
        CHECK(a->runs == 1); // nobody asked for it: d is done
        runAlone(scheduler, a);
        CHECK(a->runs == 2);
        CHECK(d->runs == 1);
    }
    SUBCASE("data changed after data needed") {
        a->markUndone(Task::Reason::dataNeeded);
        a->markUndone(Task::Reason::dataChanged);
        CHECK_FALSE(d->done());
    }
    SUBCASE("dependency changed: nothing is newer") {
        b->markUndone(Task::Reason::dependencyChanged);
        CHECK(a->done());
        CHECK_FALSE(d->done());
        runAll();
        CHECK(d->done());
        CHECK(b->runs == 1);
        CHECK(d->runs == 1);
        CHECK(scheduler.statistics().skipped == 2);
        CHECK(scheduler.statistics().executed == 0);
    }
}

TEST_CASE("A task is skipped unless an input really gets a newer date") {
    MultithreadScheduler scheduler;
    bool changes = true;
    const auto input = cpuTask([&] { return changes; });
    const auto task = cpuTask();
    task->addPredecessor(input);
    runAlone(scheduler, task);
    const Task::Date first = input->completionDate();
    CHECK(first >= 2);
    CHECK(task->predecessorsDate() == first);
    CHECK(task->completionDate() > first);

    SUBCASE("unchanged result") {
        // Dependency changed, so that the date of the input is kept when run() returns false.
        const auto beforeInput = cpuTask();
        input->addPredecessor(beforeInput);
        changes = false;
        runAlone(scheduler, task);
        CHECK(input->runs == 2);
        CHECK(input->completionDate() == first);
        CHECK(task->runs == 1);
        CHECK(task->done());
    }
    SUBCASE("changed result") {
        input->markUndone(Task::Reason::dataChanged);
        runAlone(scheduler, task);
        CHECK(input->runs == 2);
        CHECK(input->completionDate() > first);
        CHECK(task->runs == 2);
    }
    SUBCASE("the input ran in an earlier graph") {
        input->markUndone(Task::Reason::dataChanged);
        runAlone(scheduler, input);
        CHECK(task->runs == 1);
        runAlone(scheduler, task);
        CHECK(input->runs == 2);
        CHECK(task->runs == 2);
    }
    SUBCASE("another scheduler ran the input") {
        MultithreadScheduler other;
        input->markUndone(Task::Reason::dataChanged);
        runAlone(other, input);
        runAlone(scheduler, task);
        CHECK(task->runs == 2);
        task->rearm();
        runAlone(other, task);
        CHECK(task->runs == 3);
    }
    SUBCASE("a task whose first run changed nothing runs again when it has to be looked at") {
        const auto never = cpuTask([] { return false; });
        runAlone(scheduler, never);
        CHECK(never->done());
        CHECK(never->completionDate() == 0);
        never->markUndone(Task::Reason::dependencyChanged);
        runAlone(scheduler, never);
        CHECK(never->runs == 2);
    }
}

TEST_CASE("Inputs are owned, dependents are not") {
    auto input = cpuTask();
    std::weak_ptr<Task> watched = input;
    auto task = cpuTask();
    task->addPredecessor(input);
    task->addPredecessor(input);
    CHECK(task->predecessors().size() == 1);
    CHECK(input->dependents().size() == 1);
    SUBCASE("the dependent goes") {
        task.reset();
        CHECK(input->dependents().empty());
        input->markUndone(Task::Reason::dataChanged);
    }
    SUBCASE("the input is let go by others") {
        input.reset();
        CHECK_FALSE(watched.expired());
        task.reset();
        CHECK(watched.expired());
    }
    SUBCASE("the inputs are cleared") {
        task->clearPredecessors();
        CHECK(input->dependents().empty());
        CHECK(task->predecessors().empty());
    }
}

TEST_CASE("A new input makes a done task undone, and its dependents") {
    MultithreadScheduler scheduler;
    const auto task = cpuTask(), after = cpuTask(), input = cpuTask();
    after->addPredecessor(task);
    runAlone(scheduler, after);
    task->addPredecessor(input);
    CHECK_FALSE(task->done());
    CHECK_FALSE(after->done());
    runAlone(scheduler, after);
    CHECK(input->runs == 1);
    CHECK(task->runs == 2);
    CHECK(after->runs == 2);
}

TEST_CASE("A graph adds a task once, with the inputs that are not done") {
    const auto input = cpuTask(), task = cpuTask();
    task->addPredecessor(input);
    TaskGraph graph;
    CHECK(graph.empty());
    const TaskGraph::Node node = graph.add(task);
    CHECK(node);
    CHECK(graph.size() == 2);
    CHECK(graph.add(task) == node);
    CHECK(graph.add(input) == graph.find(*input));
    CHECK(graph.size() == 2);

    MultithreadScheduler scheduler;
    scheduler.run(graph);
    CHECK(input->runs == 1);
    CHECK(task->runs == 1);
    scheduler.run(graph); // all done
    CHECK(task->runs == 1);

    graph.clear();
    CHECK_FALSE(graph.find(*task));
    CHECK_FALSE(graph.add(task));
    CHECK(graph.empty());
    input->markUndone(Task::Reason::dataNeeded);
    CHECK_FALSE(graph.add(task));
    CHECK(graph.add(input));
    CHECK(graph.size() == 1);
}

TEST_CASE("A task may be in two graphs at a time") {
    const auto task = cpuTask();
    TaskGraph first, second;
    first.add(task);
    second.add(task);
    first.add(task);
    MultithreadScheduler scheduler;
    scheduler.run(first);
    scheduler.run(second);
    CHECK(task->runs == 1);
}

TEST_CASE("An everyFrame task runs in each graph it is added to") {
    MultithreadScheduler scheduler;
    TaskGraph graph;
    const auto draw = gpuTask();
    draw->setEveryFrame(true);
    for (int frame = 1; frame <= 3; ++frame) {
        graph.clear();
        CHECK(graph.add(draw));
        CHECK(graph.add(draw)); // once a frame
        scheduler.run(graph);
        CHECK(draw->runs == frame);
    }
}

TEST_CASE("A task that becomes part of a graph may choose its inputs then") {
    struct Choosing : TestTask {
        using TestTask::TestTask;
        void prepare() override {
            ++prepared;
            addPredecessor(chosen);
        }
        std::shared_ptr<TestTask> chosen = cpuTask();
        int prepared = 0;
    };
    const auto task = std::make_shared<Choosing>(Task::Kind::cpu, TestTask::Function{});
    TaskGraph graph;
    graph.add(task);
    graph.add(task);
    CHECK(task->prepared == 1);
    CHECK(graph.size() == 2);
    MultithreadScheduler scheduler;
    scheduler.run(graph);
    CHECK(task->done());
    CHECK(task->chosen->runs == 1);
    graph.clear();
    graph.add(task);
    CHECK(task->prepared == 1); // it is done
}
