// SPDX-License-Identifier: BSD-3-Clause
// Random graphs against an interpreter that follows Ork reference 5.1 to the letter, on one thread.
#include "task/multithread_scheduler.h"

#include "test_task.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <random>
#include <set>
#include <thread>
#include <vector>

using namespace terrane;

namespace {

using Random = std::mt19937;

unsigned below(Random& random, unsigned limit) {
    return static_cast<unsigned>(random() % limit);
}

bool oneIn(Random& random, unsigned n) {
    return below(random, n) == 0;
}

/// Whether the n-th run of a task changes its result: any rule that both sides can follow.
bool changes(unsigned seed, std::size_t task, int run) {
    const auto hash = (seed * 2654435761u) ^ (static_cast<unsigned>(task) * 40503u) ^
                      (static_cast<unsigned>(run) * 2246822519u);
    return (hash >> 7) % 3 != 0;
}

/// The interpreter. Task numbers are such that inputs have smaller numbers.
struct Model {
    struct Entry {
        std::vector<std::size_t> inputs;
        bool everyFrame = false;
        bool throws = false;
        bool done = false;
        unsigned long completion = 0, predecessors = 1;
        int runs = 0;
    };

    unsigned seed = 0;
    std::vector<Entry> entries;
    unsigned long time = 2;

    void undo(std::size_t task, Task::Reason reason) {
        Entry& entry = entries[task];
        entry.done = false;
        if (reason != Task::Reason::dependencyChanged) entry.completion = 0;
        if (reason == Task::Reason::dataNeeded) return;
        for (std::size_t i = task + 1; i < entries.size(); ++i)
            if (std::count(entries[i].inputs.begin(), entries[i].inputs.end(), task))
                undo(i, Task::Reason::dependencyChanged);
    }

    /// The members of a graph that these tasks were added to.
    std::set<std::size_t> close(const std::set<std::size_t>& wanted) {
        std::set<std::size_t> members;
        std::vector<std::size_t> pending(wanted.begin(), wanted.end());
        while (!pending.empty()) {
            const std::size_t task = pending.back();
            pending.pop_back();
            if (members.count(task)) continue;
            if (entries[task].everyFrame) undo(task, Task::Reason::dataNeeded);
            if (entries[task].done) continue;
            members.insert(task);
            const auto& inputs = entries[task].inputs;
            pending.insert(pending.end(), inputs.begin(), inputs.end());
        }
        return members;
    }

    /// Inputs before what needs them; the order among others doesn't matter to the counts.
    void run(const std::set<std::size_t>& members) {
        for (const std::size_t task : members) {
            Entry& entry = entries[task];
            if (entry.completion < entry.predecessors) {
                const bool changed = changes(seed, task, ++entry.runs) && !entry.throws;
                if (changed) {
                    entry.completion = time;
                    for (Entry& later : entries) // a new date is pushed to the successors
                        if (std::count(later.inputs.begin(), later.inputs.end(), task))
                            later.predecessors = time;
                }
            }
            ++time;
            entry.done = true;
        }
    }
};

/// One random world: tasks in the model and for real.
class World {
public:
    explicit World(unsigned seed)
        : random_(seed) {
        model_.seed = seed;
        const std::size_t count = 2 + below(random_, 24);
        for (std::size_t i = 0; i < count; ++i)
            addTask(i);
    }

    void frame(Scheduler& scheduler) {
        invalidate(scheduler);
        build();
        clock_ = 0;
        std::fill(started_.begin(), started_.end(), 0u);
        const auto members = model_.close(wanted_);
        std::vector<int> runsBefore;
        for (const auto& entry : model_.entries)
            runsBefore.push_back(entry.runs);
        model_.run(members);
        scheduler.run(graph_);
        compare();
        compareOrder();
        unsigned executed = 0;
        for (std::size_t i = 0; i < runsBefore.size(); ++i)
            executed += static_cast<unsigned>(model_.entries[i].runs - runsBefore[i]);
        CHECK(scheduler.statistics().executed == executed);
        CHECK(scheduler.statistics().skipped == members.size() - executed);
    }

private:
    void addTask(std::size_t i) {
        started_.push_back(0);
        ended_.push_back(0);
        Model::Entry entry;
        entry.everyFrame = oneIn(random_, 6);
        entry.throws = oneIn(random_, 15);
        const auto kind = oneIn(random_, 3) ? Task::Kind::gpu : Task::Kind::cpu;
        auto task = std::make_shared<TestTask>(kind, [this, i]() -> bool {
            started_[i] = ++clock_;
            const bool changed = changes(model_.seed, i, tasks_[i]->runs);
            ended_[i] = ++clock_;
            if (model_.entries[i].throws) throw std::runtime_error("thrown");
            return changed;
        });
        task->setEveryFrame(entry.everyFrame);
        if (kind == Task::Kind::gpu && oneIn(random_, 2))
            task->sharedContext = &contexts_[below(random_, 2)];
        task->onBegin = [this] { CHECK(++open_ == 1); };
        task->onEnd = [this] { CHECK(--open_ == 0); };
        for (std::size_t input = 0; input < i; ++input)
            if (oneIn(random_, static_cast<unsigned>(i) / 2 + 2)) {
                task->addPredecessor(tasks_[input]);
                entry.inputs.push_back(input);
            }
        tasks_.push_back(std::move(task));
        model_.entries.push_back(std::move(entry));
    }

    void invalidate(Scheduler& scheduler) {
        for (unsigned n = below(random_, 4); n > 0; --n) {
            const std::size_t task = below(random_, static_cast<unsigned>(tasks_.size()));
            const auto reason = static_cast<Task::Reason>(below(random_, 3));
            model_.undo(task, reason);
            scheduler.reschedule(*tasks_[task], reason);
        }
    }

    /// Adds some tasks in any order, and dependencies from smaller to larger numbers among those
    /// that are in, sometimes through a join.
    void build() {
        graph_.clear();
        wanted_.clear();
        edges_.clear();
        for (unsigned n = below(random_, 8); n > 0; --n) {
            const std::size_t task = below(random_, static_cast<unsigned>(tasks_.size()));
            wanted_.insert(task);
            graph_.add(tasks_[task]);
        }
        for (unsigned n = below(random_, 12); n > 0; --n) {
            const std::size_t a = below(random_, static_cast<unsigned>(tasks_.size()));
            const std::size_t b = below(random_, static_cast<unsigned>(tasks_.size()));
            const auto earlier = graph_.find(*tasks_[std::min(a, b)]);
            const auto later = graph_.find(*tasks_[std::max(a, b)]);
            if (a == b || !earlier || !later) continue;
            edges_.emplace_back(std::min(a, b), std::max(a, b));
            if (oneIn(random_, 4)) {
                const auto join = graph_.join();
                graph_.addDependency(later, join);
                graph_.addDependency(join, earlier);
            } else {
                graph_.addDependency(later, earlier);
            }
        }
    }

    void compare() {
        for (std::size_t i = 0; i < tasks_.size(); ++i) {
            CAPTURE(i);
            const Model::Entry& entry = model_.entries[i];
            CHECK(tasks_[i]->runs == entry.runs);
            CHECK(tasks_[i]->done() == entry.done);
            CHECK((tasks_[i]->completionDate() == 0) == (entry.completion == 0));
        }
        CHECK(open_ == 0);
    }

    void compareOrder() {
        const auto ordered = [&](std::size_t earlier, std::size_t later) {
            if (!started_[earlier] || !started_[later]) return; // one of them did not run
            CHECK(ended_[earlier] < started_[later]);
        };
        for (std::size_t i = 0; i < tasks_.size(); ++i)
            for (const std::size_t input : model_.entries[i].inputs)
                ordered(input, i);
        for (const auto& [earlier, later] : edges_)
            ordered(earlier, later);
    }

    Random random_;
    Model model_;
    std::vector<std::shared_ptr<TestTask>> tasks_;
    std::vector<unsigned> started_, ended_;
    std::atomic<unsigned> clock_ = 0;
    int contexts_[2] = {};
    int open_ = 0;
    TaskGraph graph_;
    std::set<std::size_t> wanted_;
    std::vector<std::pair<std::size_t, std::size_t>> edges_;
};

} // namespace

TEST_CASE("Random graphs run what the reference says, as often, in order") {
    for (const unsigned workers : {0u, 1u, 2u, 4u}) {
        CAPTURE(workers);
        MultithreadScheduler scheduler({.nthreads = workers});
        for (unsigned seed = 0; seed < 300; ++seed) {
            CAPTURE(seed);
            World world(seed * 4 + workers);
            for (int frame = 0; frame < 6; ++frame) {
                CAPTURE(frame);
                world.frame(scheduler);
            }
        }
    }
}

// Values that flow from task to task, as tiles do, while workers prefetch, sources change at any
// moment and the owner needs results at once: in the end each value is that of a computation from
// scratch. A task that read while another wrote would be found by the thread sanitizer.
TEST_CASE("Results are those of the newest data, whatever is invalidated while tasks run") {
    struct Cell {
        std::atomic<unsigned> source = 0; // set by the owner at any time
        unsigned value = 0;               // written by the task
        std::vector<std::size_t> inputs;
        std::shared_ptr<TestTask> task;
    };
    for (const unsigned workers : {0u, 1u, 2u, 4u}) {
        CAPTURE(workers);
        for (unsigned seed = 0; seed < 60; ++seed) {
            CAPTURE(seed);
            Random random(seed);
            std::vector<Cell> cells(4 + below(random, 30));
            const auto compute = [&cells](std::size_t i) {
                unsigned value = cells[i].source * 7919u + static_cast<unsigned>(i);
                for (const std::size_t input : cells[i].inputs)
                    value = value * 31u + cells[input].value;
                return value;
            };
            MultithreadScheduler scheduler(
                {.nthreads = workers, .prefetchRate = 2, .prefetchQueue = 16});
            for (std::size_t i = 0; i < cells.size(); ++i) {
                const auto run = [&cells, &compute, i] {
                    const unsigned value = compute(i);
                    std::this_thread::yield(); // let others interfere
                    return std::exchange(cells[i].value, value) != value;
                };
                cells[i].task = oneIn(random, 4) ? gpuTask(run, "Gpu", Task::kWhenever)
                                                 : cpuTask(run, "Cpu", Task::kWhenever);
                for (std::size_t input = 0; input < i; ++input)
                    if (oneIn(random, static_cast<unsigned>(i) / 2 + 2)) {
                        cells[i].inputs.push_back(input);
                        cells[i].task->addPredecessor(cells[input].task);
                    }
            }
            const auto any = [&] { return below(random, static_cast<unsigned>(cells.size())); };
            TaskGraph graph;
            for (int frame = 0; frame < 30; ++frame) {
                for (unsigned n = below(random, 4); n > 0; --n)
                    scheduler.schedule(cells[any()].task);
                for (unsigned n = below(random, 3); n > 0; --n) {
                    Cell& changed = cells[any()];
                    ++changed.source;
                    scheduler.reschedule(*changed.task, Task::Reason::dataChanged);
                }
                if (oneIn(random, 3))
                    scheduler.reschedule(*cells[any()].task, Task::Reason::dataNeeded, 3);
                graph.clear();
                for (unsigned n = below(random, 3); n > 0; --n) {
                    Cell& needed = cells[any()];
                    if (oneIn(random, 2)) needed.task->setDeadline(Task::kImmediate);
                    graph.add(needed.task);
                }
                scheduler.run(graph);
            }
            // What was marked while it was queued may need a second look.
            for (int pass = 0; pass < 3; ++pass) {
                graph.clear();
                for (Cell& cell : cells) {
                    cell.task->setDeadline(Task::kImmediate);
                    graph.add(cell.task);
                }
                scheduler.run(graph);
            }
            scheduler.waitIdle();
            for (std::size_t i = 0; i < cells.size(); ++i) {
                CAPTURE(i);
                CHECK(cells[i].task->done());
                CHECK(cells[i].value == compute(i));
            }
        }
    }
}
