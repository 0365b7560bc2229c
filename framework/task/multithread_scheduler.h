// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "task/duration_table.h"
#include "task/job_queue.h"
#include "task/scheduler.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace terrane {

/// Runs tasks on the calling thread and on workers (Ork reference 5.5).
///
/// Workers take CPU tasks, of this frame and of future ones. GPU tasks run on the calling thread.
/// Ready tasks go by deadline, context, expected duration (only with a frame rate), then in the
/// order in which they were added; what a task with a lower deadline waits for inherits it. Without
/// workers and frame rate the order is the same in every program run.
///
/// Logical times come from the steady clock, each later than the one before: dates given by one
/// scheduler may be compared with those given by another that replaced it.
class MultithreadScheduler : public Scheduler {
public:
    struct Options {
        unsigned nthreads = 0;      ///< workers, beside the calling thread
        double fps = 0;             ///< frames per second that run() paces to; 0: it never waits
        unsigned prefetchRate = 0;  ///< future tasks that run() itself does, if so many are ready
        unsigned prefetchQueue = 0; ///< future tasks that may wait (see supportsPrefetch)
    };

    MultithreadScheduler();
    explicit MultithreadScheduler(const Options& options);
    /// Waits for the tasks that are running; those that are queued are dropped, undone.
    ~MultithreadScheduler() override;

    const Options& options() const { return options_; }

    /// With a prefetch rate or a frame rate, or for CPU tasks if there are workers; for GPU tasks,
    /// or without workers, the queue must not be full either.
    bool supportsPrefetch(Task::Kind kind) const override;
    bool schedule(const std::shared_ptr<Task>& task) override;
    void reschedule(Task& task, Task::Reason reason, unsigned deadline = Task::kImmediate) override;
    void run(const TaskGraph& graph) override;
    void waitIdle() override;
    void drop() override;
    SchedulerStatistics statistics() const override;
    void setErrorHandler(ErrorHandler handler) override;
    void setObserver(Observer observer) override;

private:
    using Clock = TaskRun::Clock;
    using Lock = std::unique_lock<std::mutex>;
    struct Outcome;

    void work(unsigned thread);
    void runImmediate(Lock& lock);
    void runFuture(Lock& lock);
    void execute(Lock& lock, JobQueue::Index job, unsigned thread);
    Outcome runTask(Task& task, unsigned thread, const Observer* observer);
    void openContext();
    void closeContext();
    void breakCycle(Lock& lock);
    void report(const Task& task, const char* what);
    void wakeWorkers();
    void waitForWorkers(Lock& lock);
    void releaseEnded();
    void advanceDate();
    bool supports(Task::Kind kind) const;
    JobQueue::Index best() const;

    const Options options_;
    const Clock::duration period_;

    mutable std::mutex mutex_; // guards everything down to the line
    JobQueue queue_;
    DurationTable durations_;
    Task::Date date_ = 2;
    SchedulerStatistics current_, last_;
    std::shared_ptr<const ErrorHandler> errorHandler_;
    std::shared_ptr<const Observer> observer_;
    std::condition_variable workersWake_, callerWakes_;
    unsigned idleWorkers_ = 0;
    bool callerWaits_ = false;
    bool paused_ = false, stop_ = false;
    // --- owner thread only
    bool busy_ = false; // in run() or waitIdle()
    const void* openContext_ = nullptr;
    std::shared_ptr<Task> contextTask_;     // the last one of the open context
    std::shared_ptr<Task> nextContextTask_; // the GPU task that is about to run
    unsigned contextSwitches_ = 0;
    Clock::time_point previousEnd_{};
    TaskGraph prefetch_;
    std::vector<std::shared_ptr<Task>> ended_;

    std::vector<std::thread> workers_;
};

} // namespace terrane
