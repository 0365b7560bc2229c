// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

namespace terrane {

/// A piece of work whose result is kept: one tile of a producer, one draw command of a frame. Used
/// through std::shared_ptr. It is run by a Scheduler and, once done, not again until something that
/// it depends on changes (Ork reference 5.1).
///
///     auto upsampled = std::make_shared<UpsampleTile>(...);   // a subclass with run()
///     upsampled->addPredecessor(parent->task());              // its input: owned by it
///     graph.add(upsampled);                                   // brings the parent along if needed
///     scheduler.run(graph);
///
/// Dates are logical times. completionDate() is that of the last *change* of the result,
/// predecessorsDate() the latest one among the inputs; a scheduler skips run() when the first is
/// not older than the second.
///
/// Threads: everything is called, and the last reference dropped, on the thread that owns the
/// scheduler (the GL thread), with these exceptions: run() of a CPU task may be called on a worker,
/// and done(), failed() and the dates may be read anywhere. When done() is true, what run() wrote
/// may be read.
class Task {
public:
    /// GPU tasks run on the thread that owns the GL context only.
    enum class Kind : std::uint8_t { cpu, gpu };

    /// Why a task has to be looked at again.
    enum class Reason : std::uint8_t {
        dependencyChanged, ///< run again only if an input really gets a newer date
        dataChanged,       ///< its own data is out of date: runs again, dependents are told
        dataNeeded,        ///< its result was lost, but is not out of date: dependents aren't told
    };

    using Date = std::uint64_t;

    static constexpr unsigned kImmediate = 0;       ///< due in this frame
    static constexpr unsigned kWhenever = 1u << 31; ///< no frame waits for it

    /// @param name class name for metrics, trace and messages; must live as long as the program
    Task(Kind kind, std::string_view name, unsigned deadline = kImmediate);
    virtual ~Task();
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;

    Kind kind() const { return kind_; }
    std::string_view name() const { return name_; }

    /// Called when the task, undone, becomes part of a graph: the last chance to change its inputs.
    /// On the owner thread; a worker may be running the task at that moment, prefetched before.
    /// Must not schedule tasks or add them to a graph.
    virtual void prepare() {}

    /// GPU tasks with equal contexts are run one after the other where possible, between one
    /// begin() of the first and one end() of the last. Null: neither is called. Unused on CPU
    /// tasks.
    virtual const void* context() const { return nullptr; }
    virtual void begin() {}
    virtual void end() {}

    /// Does the work; returns whether the result changed. An exception counts as "did not change".
    virtual bool run() = 0;

    /// The number of the frame by which it must be done. Setting it can only lower it; a task that
    /// gets done has its first deadline again.
    unsigned deadline() const { return deadline_.load(std::memory_order_relaxed); }
    void setDeadline(unsigned deadline);

    /// The expected duration is proportional to it; at least 1.
    int complexity() const { return complexity_; }
    void setComplexity(int complexity) { complexity_ = complexity < 1 ? 1 : complexity; }

    /// A task of a frame, such as a draw command: adding it to a graph makes it run again.
    bool everyFrame() const { return everyFrame_; }
    void setEveryFrame(bool everyFrame) { everyFrame_ = everyFrame; }

    bool done() const { return done_.load(std::memory_order_acquire); }
    /// True when the last run() threw. It counts as done all the same, so that a frame goes on.
    bool failed() const { return failed_.load(std::memory_order_relaxed); }
    Date completionDate() const { return completionDate_.load(std::memory_order_relaxed); }
    /// Like completionDate(), but kept when the latter is reset so that the task runs again: what
    /// dependents that haven't run since compare themselves with.
    Date changeDate() const { return changeDate_.load(std::memory_order_relaxed); }
    Date predecessorsDate() const { return predecessorsDate_.load(std::memory_order_relaxed); }

    /// Makes `earlier` an input: it is kept alive, and runs before. An input that is listed already
    /// isn't listed twice; a new one marks this task undone (dependencyChanged). A cycle is never
    /// released and is reported by the scheduler.
    void addPredecessor(std::shared_ptr<Task> earlier);
    /// Forgets all inputs; marks nothing.
    void clearPredecessors();
    const std::vector<std::shared_ptr<Task>>& predecessors() const { return predecessors_; }
    const std::vector<Task*>& dependents() const { return dependents_; }

    /// Makes the task undone; dependents are told transitively (dependencyChanged) unless the
    /// reason is dataNeeded. A task that is running at that moment will run once more when it is
    /// next part of a graph. Schedules nothing. Prefer Scheduler::reschedule.
    void markUndone(Reason reason);
    /// Makes this task alone run again.
    void rearm() { markUndone(Reason::dataNeeded); }

    // What follows is for schedulers.

    /// Counts the marks; a task gets done only if none arrived since the ticket was taken.
    using Ticket = unsigned;
    Ticket ticket() const;

    enum class Start { run, skipped, skippedUndone };
    /// Applies the skip rule. Skipped: the task is done, or stays undone because it was marked
    /// after the ticket, or `tainted` (one of its inputs was). Run: call run(), then complete().
    Start start(Ticket ticket, bool tainted);
    /// Ends a run. @return whether the task is done now.
    bool complete(Date now, bool changed, bool failed, Ticket ticket, bool tainted);
    void raisePredecessorsDate(Date date);

private:
    friend class TaskGraph;
    friend class JobQueue;

    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    bool mark(Reason reason);
    bool settle(Ticket ticket, bool tainted);

    const Kind kind_;
    bool everyFrame_ = false;
    int complexity_ = 1;
    const std::string_view name_;
    const unsigned firstDeadline_;
    std::atomic<unsigned> deadline_;

    std::atomic<bool> done_ = false;
    std::atomic<bool> failed_ = false;
    std::atomic<Date> completionDate_ = 0;
    std::atomic<Date> changeDate_ = 0;
    std::atomic<Date> predecessorsDate_ = 1;

    mutable std::mutex mutex_; // guards the changes of the state above and the following
    bool stale_ = true;        // undone, and so are all dependents: marks may stop here
    Ticket marks_ = 0;
    unsigned dataMarks_ = 0;
    unsigned dataMarksAtStart_ = 0;

    std::vector<std::shared_ptr<Task>> predecessors_;
    std::vector<Task*> dependents_;

    std::uint32_t graphIndex_ = kNone; // where a TaskGraph may have it
    std::uint32_t job_ = kNone;        // where a JobQueue has it
};

} // namespace terrane
