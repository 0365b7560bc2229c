// SPDX-License-Identifier: BSD-3-Clause
#include "task/declare.h"

#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"
#include "task/multithread_scheduler.h"

namespace terrane {

namespace {

// Far more than helps on any machine: a slip of the pen.
constexpr int kMaxThreads = 256;

struct MultithreadSchedulerDescription : ElementDescription {
    Attr<int> nthreads = 0;
    Attr<double> fps = 0;
    Attr<int> prefetchRate = 0;
    Attr<int> prefetchQueue = 0;
};

void checkQueue(const MultithreadSchedulerDescription& d, Diagnostics& diagnostics) {
    if (d.prefetchQueue > 0 || (d.fps <= 0 && d.prefetchRate <= 0)) return;
    diagnostics.error("out-of-range", d.prefetchQueue.place,
                      "'fps' and 'prefetchRate' need a queue for the tasks of future frames",
                      "a 'prefetchQueue' of at least 1");
}

std::shared_ptr<MultithreadScheduler> build(const MultithreadSchedulerDescription& d,
                                            BuildContext& context) {
    auto scheduler = std::make_shared<MultithreadScheduler>(MultithreadScheduler::Options{
        .nthreads = static_cast<unsigned>(*d.nthreads),
        .fps = *d.fps,
        .prefetchRate = static_cast<unsigned>(*d.prefetchRate),
        .prefetchQueue = static_cast<unsigned>(*d.prefetchQueue),
    });
    // Those of the manager: the scheduler outlives the build.
    Diagnostics& diagnostics = context.manager().diagnostics();
    scheduler->setErrorHandler([&diagnostics](const Task& task, const std::string& message) {
        diagnostics.error("task-failed", {}, std::string(task.name()) + ": " + message);
    });
    return scheduler;
}

} // namespace

void declareScheduler(Registry& registry) {
    using D = MultithreadSchedulerDescription;
    registry.nameInterface<Scheduler>("scheduler");
    registry
        .resource<MultithreadScheduler, D, Scheduler>(
            "multithreadScheduler", "Runs the tasks of a frame, and prefetches for the next ones.")
        .example(R"(<multithreadScheduler name="defaultScheduler" nthreads="2"/>)")
        .attribute("nthreads", &D::nthreads, "worker threads beside the main one")
        .atLeast(0)
        .atMost(kMaxThreads)
        .clamped()
        .attribute("fps", &D::fps, "frame rate to keep to; 0: as fast as possible")
        .unit("1/s")
        .atLeast(0)
        .atMost(1e6)
        .clamped()
        .attribute("prefetchRate", &D::prefetchRate,
                   "tasks of future frames that the main thread runs in each frame, at least")
        .atLeast(0)
        .clamped()
        .attribute("prefetchQueue", &D::prefetchQueue,
                   "tasks of future frames that may wait; needed with 'fps' or 'prefetchRate'")
        .atLeast(0)
        .clamped()
        .check(checkQueue)
        .build(build);
}

} // namespace terrane
