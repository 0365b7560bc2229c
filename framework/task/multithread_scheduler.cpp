// SPDX-License-Identifier: BSD-3-Clause
#include "task/multithread_scheduler.h"

#include <algorithm>
#include <cassert>
#include <exception>
#include <system_error>

namespace terrane {

namespace {

// Ork reference 5.5: a frame ends this much before its period does, for what the host does then.
constexpr auto kMargin = std::chrono::milliseconds(1);

} // namespace

struct MultithreadScheduler::Outcome {
    bool changed = false;
    bool failed = false;
    double seconds = 0; // if measured
};

MultithreadScheduler::MultithreadScheduler()
    : MultithreadScheduler(Options{}) {}

MultithreadScheduler::MultithreadScheduler(const Options& options)
    : options_(options)
    , period_(options.fps > 0 ? std::chrono::duration_cast<Clock::duration>(
                                    std::chrono::duration<double>(1 / options.fps))
                              : Clock::duration::zero()) {
    advanceDate();
    workers_.reserve(options.nthreads);
    try {
        for (unsigned i = 0; i < options.nthreads; ++i)
            workers_.emplace_back([this, i] { work(i + 1); });
    } catch (const std::system_error&) {
        // As many as the system grants; without any, all is done on the calling thread.
    }
}

MultithreadScheduler::~MultithreadScheduler() {
    drop();
    {
        const Lock lock(mutex_);
        stop_ = true;
    }
    workersWake_.notify_all();
    for (std::thread& worker : workers_)
        worker.join();
}

// --- scheduling --------------------------------------------------------------------------------

bool MultithreadScheduler::supportsPrefetch(Task::Kind kind) const {
    const Lock lock(mutex_);
    return supports(kind);
}

bool MultithreadScheduler::supports(Task::Kind kind) const {
    const bool byWorkers = !workers_.empty() && kind == Task::Kind::cpu;
    if (byWorkers) return true;
    const bool byCaller = options_.prefetchRate > 0 || options_.fps > 0;
    return byCaller && queue_.future() < options_.prefetchQueue;
}

bool MultithreadScheduler::schedule(const std::shared_ptr<Task>& task) {
    assert(prefetch_.empty() && "Scheduler::schedule: called by Task::prepare");
    if (!prefetch_.empty()) return false;
    if (!busy_) releaseEnded();
    prefetch_.add(task);
    bool supported = true;
    {
        const Lock lock(mutex_);
        for (const TaskGraph::Member& member : prefetch_.members())
            supported = supported && supports(member.task->kind());
        if (supported) {
            advanceDate();
            queue_.enqueue(prefetch_, durations_);
            wakeWorkers();
        }
    }
    prefetch_.clear();
    return supported;
}

void MultithreadScheduler::reschedule(Task& task, Task::Reason reason, unsigned deadline) {
    task.markUndone(reason);
    if (reason != Task::Reason::dataNeeded) return;
    task.setDeadline(deadline);
    const Lock lock(mutex_);
    queue_.lower(task, deadline);
}

// Logical time: never behind the clock, so that no other scheduler was ahead of it before.
void MultithreadScheduler::advanceDate() {
    const auto now = Clock::now().time_since_epoch();
    const auto ticks = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
    date_ = std::max(date_ + 1, static_cast<Task::Date>(ticks));
}

// --- the calling thread ------------------------------------------------------------------------

void MultithreadScheduler::run(const TaskGraph& graph) {
    assert(!busy_ && "Scheduler::run: called by a task");
    busy_ = true;
    {
        Lock lock(mutex_);
        advanceDate();
        queue_.enqueue(graph, durations_);
        runImmediate(lock);
        runFuture(lock);
        wakeWorkers();
        lock.unlock();
        closeContext();
        lock.lock();
        current_.contextSwitches = contextSwitches_;
        current_.waiting = queue_.future();
        last_ = current_;
        current_ = {};
    }
    contextSwitches_ = 0;
    if (options_.fps > 0) previousEnd_ = Clock::now();
    busy_ = false;
    releaseEnded();
}

JobQueue::Index MultithreadScheduler::best() const {
    return queue_.best(openContext_, !workers_.empty());
}

void MultithreadScheduler::runImmediate(Lock& lock) {
    while (queue_.immediate() > 0) {
        const JobQueue::Index job = best();
        if (job != JobQueue::kNone && queue_[job].key.deadline == Task::kImmediate)
            execute(lock, job, 0);
        else if (queue_.running() > 0)
            waitForWorkers(lock);
        else
            breakCycle(lock);
    }
}

void MultithreadScheduler::runFuture(Lock& lock) {
    const bool paced = options_.fps > 0 && previousEnd_ != Clock::time_point{};
    const Clock::time_point deadline = previousEnd_ + period_ - kMargin;
    for (unsigned count = 0;;) {
        const JobQueue::Index job = best();
        const bool demanded = count < options_.prefetchRate;
        if (job != JobQueue::kNone) {
            const std::chrono::duration<double> expected(queue_[job].key.duration);
            if (demanded || (paced && Clock::now() + expected < deadline)) {
                execute(lock, job, 0);
                ++count;
                continue;
            }
        } else if (!queue_.empty() && queue_.running() == 0) {
            breakCycle(lock); // or those on it would take up the queue for ever
            continue;
        }
        if (!paced || Clock::now() >= deadline) return;
        wakeWorkers();
        callerWaits_ = true;
        callerWakes_.wait_until(lock, deadline);
        callerWaits_ = false;
    }
}

void MultithreadScheduler::waitIdle() {
    assert(!busy_ && "Scheduler::waitIdle: called by a task");
    busy_ = true;
    {
        Lock lock(mutex_);
        advanceDate();
        while (!queue_.empty()) {
            const JobQueue::Index job = best();
            if (job != JobQueue::kNone)
                execute(lock, job, 0);
            else if (queue_.running() > 0)
                waitForWorkers(lock);
            else
                breakCycle(lock);
        }
    }
    closeContext();
    busy_ = false;
    releaseEnded();
}

void MultithreadScheduler::drop() {
    assert(!busy_ && "Scheduler::drop: called by a task");
    {
        Lock lock(mutex_);
        paused_ = true;
        while (queue_.running() > 0)
            waitForWorkers(lock);
        queue_.clear();
        paused_ = false;
    }
    releaseEnded();
}

void MultithreadScheduler::waitForWorkers(Lock& lock) {
    wakeWorkers();
    callerWaits_ = true;
    callerWakes_.wait(lock);
    callerWaits_ = false;
}

void MultithreadScheduler::breakCycle(Lock& lock) {
    ++current_.cycles;
    const JobQueue::Cycle cycle = queue_.breakCycle();
    wakeWorkers();
    lock.unlock();
    if (cycle.task) report(*cycle.task, cycle.message.c_str());
    lock.lock();
}

// Tasks are released on this thread, outside of the lock: their destructors may do anything.
void MultithreadScheduler::releaseEnded() {
    {
        const Lock lock(mutex_);
        queue_.takeEnded(ended_);
    }
    ended_.clear();
}

// --- workers -----------------------------------------------------------------------------------

void MultithreadScheduler::work(unsigned thread) {
    Lock lock(mutex_);
    while (!stop_) {
        const JobQueue::Index job = queue_.bestCpu();
        if (job != JobQueue::kNone && !paused_) {
            execute(lock, job, thread);
            continue;
        }
        ++idleWorkers_;
        workersWake_.wait(lock);
        --idleWorkers_;
    }
}

// To be called by whoever leaves ready CPU tasks behind when it lets go of the lock.
void MultithreadScheduler::wakeWorkers() {
    for (auto n = std::min<std::size_t>(queue_.readyCpu(), idleWorkers_); n > 0; --n)
        workersWake_.notify_one();
}

// --- one task ----------------------------------------------------------------------------------

void MultithreadScheduler::execute(Lock& lock, JobQueue::Index job, unsigned thread) {
    if (!queue_.start(job)) {
        ++current_.skipped;
    } else {
        // The job keeps the task alive until it is finished; a worker must not be the last to.
        Task& task = *queue_[job].task;
        if (task.kind() == Task::Kind::gpu) nextContextTask_ = queue_[job].task;
        const bool future = queue_[job].key.deadline > Task::kImmediate;
        const auto observer = observer_;
        wakeWorkers();

        lock.unlock();
        const Outcome outcome = runTask(task, thread, observer.get());
        lock.lock();

        ++current_.executed;
        current_.kept += !task.everyFrame();
        current_.failed += outcome.failed;
        current_.future += future;
        current_.onWorkers += thread > 0;
        if (options_.fps > 0) durations_.record(task.name(), task.complexity(), outcome.seconds);
        queue_.finish(job, date_++, outcome.changed, outcome.failed);
    }
    if (thread > 0 && callerWaits_) callerWakes_.notify_one();
}

MultithreadScheduler::Outcome MultithreadScheduler::runTask(Task& task, unsigned thread,
                                                            const Observer* observer) {
    const bool measured = observer || options_.fps > 0;
    Outcome outcome;
    Clock::time_point start{};
    try {
        if (task.kind() == Task::Kind::gpu) openContext();
        if (measured) start = Clock::now();
        outcome.changed = task.run();
    } catch (const std::exception& exception) {
        outcome = {false, true};
        report(task, exception.what());
    } catch (...) {
        outcome = {false, true};
        report(task, "unknown exception");
    }
    if (measured && start != Clock::time_point{}) {
        const Clock::time_point end = Clock::now();
        outcome.seconds = std::chrono::duration<double>(end - start).count();
        if (observer) (*observer)({task, thread, start, end, outcome.changed, outcome.failed});
    }
    return outcome;
}

void MultithreadScheduler::openContext() {
    const std::shared_ptr<Task> task = std::move(nextContextTask_);
    const void* context = task->context();
    if (context != openContext_) {
        closeContext();
        if (!context) return;
        task->begin();
        openContext_ = context;
        ++contextSwitches_;
    }
    if (context) contextTask_ = task;
}

void MultithreadScheduler::closeContext() {
    if (!openContext_) return;
    const std::shared_ptr<Task> task = std::move(contextTask_);
    openContext_ = nullptr;
    try {
        task->end();
    } catch (const std::exception& exception) {
        report(*task, exception.what());
    } catch (...) {
        report(*task, "unknown exception");
    }
}

void MultithreadScheduler::report(const Task& task, const char* what) {
    std::shared_ptr<const ErrorHandler> handler;
    {
        const Lock lock(mutex_);
        handler = errorHandler_;
    }
    if (handler) (*handler)(task, what);
}

// --- settings ----------------------------------------------------------------------------------

SchedulerStatistics MultithreadScheduler::statistics() const {
    const Lock lock(mutex_);
    return last_;
}

void MultithreadScheduler::setErrorHandler(ErrorHandler handler) {
    auto shared = handler ? std::make_shared<const ErrorHandler>(std::move(handler)) : nullptr;
    const Lock lock(mutex_);
    errorHandler_.swap(shared);
}

void MultithreadScheduler::setObserver(Observer observer) {
    auto shared = observer ? std::make_shared<const Observer>(std::move(observer)) : nullptr;
    const Lock lock(mutex_);
    observer_.swap(shared);
}

} // namespace terrane
