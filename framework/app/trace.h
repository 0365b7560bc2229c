// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "task/scheduler.h"

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// Collects when what was run, and writes it as Chrome trace events (opens in Perfetto and in
/// chrome://tracing). Thread-safe.
class Trace {
public:
    using Clock = TaskRun::Clock;

    /// Times count from here.
    Trace();

    void addTask(const TaskRun& run);
    /// What the GL thread did between two times. `name` must live as long as the trace.
    void addSpan(std::string_view name, Clock::time_point start, Clock::time_point end);

    std::size_t size() const;
    std::string json() const;

private:
    struct Event {
        std::string_view name;        // task names live as long as the program
        std::int64_t start, duration; // nanoseconds
        unsigned thread;
        int level = -1, tx = 0, ty = 0; // of tiles
        bool changed = false, failed = false;
    };

    const Clock::time_point origin_;
    mutable std::mutex mutex_;
    std::vector<Event> events_;
};

} // namespace terrane
