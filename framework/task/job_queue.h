// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "task/duration_table.h"
#include "task/ready_list.h"
#include "task/task_graph.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace terrane {

/// What a scheduler has to do: the tasks of the graphs it was given that haven't ended, and the
/// order among them. It has no threads and no clock; the scheduler guards it with one lock.
/// Enqueues on the owner thread only (it reads the inputs and dependents of tasks).
///
/// A task has at most one job that hasn't started. Reused: nothing is allocated once the largest
/// amount of work has been met.
class JobQueue {
public:
    using Index = std::uint32_t;
    static constexpr Index kNone = ~Index{0};

    enum class State : std::uint8_t { free, blocked, ready, running };

    struct Job {
        std::shared_ptr<Task> task; ///< null for a join
        JobKey key;
        Index firstOut = kNone; ///< edges to what waits for it
        Index firstIn = kNone;  ///< edges to what it waits for
        unsigned waiting = 0;   ///< number of the latter
        Task::Ticket ticket = 0;
        State state = State::free;
        bool tainted = false; ///< an input did not get done
    };

    /// Adds the members of a graph that aren't done. Jobs that exist already are merged with.
    void enqueue(const TaskGraph& graph, const DurationTable& durations);

    const Job& operator[](Index job) const { return jobs_[job]; }
    bool empty() const { return count_ == 0; }
    /// Jobs of this frame that haven't ended.
    unsigned immediate() const { return immediate_; }
    /// Tasks of future frames that haven't started.
    unsigned future() const { return future_; }
    unsigned running() const { return running_; }
    std::size_t readyCpu() const { return cpu_.size(); }
    bool hasImmediateGpu() const {
        return !gpu_.empty() && gpu_.first().key.deadline == Task::kImmediate;
    }

    /// The CPU task to run next, or kNone.
    Index bestCpu() const { return cpu_.empty() ? kNone : cpu_.first().job; }
    /// The task for the owner thread to run next: of the smallest deadline, one of the open
    /// context; else one without a context; else the first. CPU tasks count as without a context;
    /// they come after the GPU tasks without one if `gpuFirst` (others can run them), else by their
    /// key.
    Index best(const void* openContext, bool gpuFirst) const;

    /// A ready job starts running; applies the skip rule. False: there is nothing to run, and the
    /// job has ended.
    bool start(Index job);
    /// A running job ends: its successors may become ready.
    void finish(Index job, Task::Date now, bool changed, bool failed);
    /// A lower deadline for a task that is queued, and for what it waits for.
    void lower(const Task& task, unsigned deadline);

    struct Cycle {
        std::shared_ptr<Task> task; ///< on it or behind it; null when no task is
        std::string message;
    };
    /// To be called when jobs are left, but none is ready or running: they wait for each other.
    /// Drops one dependency of one cycle, and tells which.
    Cycle breakCycle();

    /// Forgets all jobs; none may be running.
    void clear();

    /// Hands over the tasks whose jobs have ended, for the owner to release outside of the lock.
    void takeEnded(std::vector<std::shared_ptr<Task>>& ended) { ended.swap(ended_); }

private:
    struct Edge {
        Index from = kNone, to = kNone;
        Index nextOut = kNone;
        Index previousIn = kNone, nextIn = kNone;
        bool input = false;
    };

    Index create(const std::shared_ptr<Task>& task, Task::Ticket ticket,
                 const DurationTable& durations);
    Index jobOf(const TaskGraph::Member& member, const DurationTable& durations);
    Index runningJobOf(const Task& task) const;
    void connect(Index earlier, Index later, bool input);
    void guardDependents(Index job, std::uint64_t firstNew);
    void lower(Index job, unsigned deadline);
    void makeReady(Index job);
    void block(Index job);
    void end(Index job, bool done);
    void releaseSuccessors(Index job, bool done);
    void unlinkIn(Index edge);
    void unlinkOut(Index edge);
    void free(Index job);
    void setState(Job& job, State state);
    void count(const Job& job, int change);
    ReadyList& readyList(const Job& job);
    unsigned contextNumber(const void* context);
    Index onCycle(Index start) const;

    std::vector<Job> jobs_;
    std::vector<Index> freeJobs_;
    std::vector<Edge> edges_;
    std::vector<Index> freeEdges_;
    ReadyList cpu_, gpu_;
    std::vector<const void*> contexts_; // number - 1 -> context
    std::vector<std::shared_ptr<Task>> ended_;
    std::vector<Index> memberJobs_, lowering_, joins_; // scratch
    std::uint64_t nextOrder_ = 0;
    unsigned count_ = 0, immediate_ = 0, future_ = 0, running_ = 0;
};

} // namespace terrane
