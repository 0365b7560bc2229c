// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/resource.h"
#include "task/task_graph.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace terrane {

/// One call of Task::run().
struct TaskRun {
    using Clock = std::chrono::steady_clock;

    const Task& task;
    unsigned thread; ///< 0: the thread that called the scheduler; workers count from 1
    Clock::time_point start, end;
    bool changed, failed;
};

/// What happened since the run before, on all threads.
struct SchedulerStatistics {
    unsigned executed = 0;        ///< tasks whose run() was called
    unsigned kept = 0;            ///< of the executed: those whose result is kept, such as tiles
    unsigned skipped = 0;         ///< of the others: inputs unchanged
    unsigned failed = 0;          ///< of the executed: threw
    unsigned future = 0;          ///< of the executed: due in a later frame
    unsigned onWorkers = 0;       ///< of the executed: by a worker
    unsigned contextSwitches = 0; ///< calls of Task::begin()
    unsigned cycles = 0;          ///< dependencies dropped because tasks waited for each other
    unsigned waiting = 0;         ///< tasks of future frames that are still queued
};

/// Runs tasks in an order that respects their dependencies (Ork reference 5.4). All functions are
/// called on one thread, the one that owns the GL context; the handlers may be called on workers. A
/// task is used with one scheduler at a time.
class Scheduler : public Resource {
public:
    /// Told of exceptions thrown by tasks, and of tasks that wait for each other.
    using ErrorHandler = std::function<void(const Task&, const std::string& message)>;
    /// Told of each task that was run, for trace and metrics. Skipped tasks are not mentioned.
    using Observer = std::function<void(const TaskRun&)>;

    /// Whether tasks of future frames of this kind may be scheduled now.
    virtual bool supportsPrefetch(Task::Kind kind) const = 0;

    /// Queues a task, and the inputs it needs, for a future frame; a task that is queued already
    /// stays so. Returns at once. May be called by tasks that run on the owner thread.
    /// @return false when prefetch is not supported for all of them; nothing is queued then
    virtual bool schedule(const std::shared_ptr<Task>& task) = 0;

    /// Marks a task undone (see Task::markUndone) and, if its data is needed, lowers the deadline
    /// of it and of what it waits for in the queue. Queues nothing: the task runs when it is next
    /// scheduled, or part of a graph.
    virtual void reschedule(Task& task, Task::Reason reason,
                            unsigned deadline = Task::kImmediate) = 0;

    /// Runs the immediate tasks of a graph, and those scheduled before; returns when all have
    /// ended. The other tasks of the graph are queued. An exception in a task is reported, and the
    /// task counts as done without a change. Tasks that wait for each other are reported, and run.
    virtual void run(const TaskGraph& graph) = 0;

    /// Runs all tasks of future frames too; returns when nothing is queued.
    virtual void waitIdle() = 0;

    /// Forgets all tasks that are queued, and waits for those that are running. They stay undone.
    /// To be called before its tasks are used with another scheduler.
    virtual void drop() = 0;

    /// Of the last run().
    virtual SchedulerStatistics statistics() const = 0;

    /// Handlers must be thread-safe; an empty one is none.
    virtual void setErrorHandler(ErrorHandler handler) = 0;
    virtual void setObserver(Observer observer) = 0;
};

} // namespace terrane
