// SPDX-License-Identifier: BSD-3-Clause
#include "app/trace.h"

#include "producer/create_tile.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <set>

namespace terrane {

namespace {

std::int64_t nanoseconds(Trace::Clock::duration duration) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
}

} // namespace

Trace::Trace()
    : origin_(Clock::now()) {}

void Trace::addTask(const TaskRun& run) {
    Event event{run.task.name(), nanoseconds(run.start - origin_), nanoseconds(run.end - run.start),
                run.thread};
    if (const auto* tile = dynamic_cast<const CreateTile*>(&run.task)) {
        event.level = tile->tile().level;
        event.tx = tile->tile().tx;
        event.ty = tile->tile().ty;
    }
    event.changed = run.changed;
    event.failed = run.failed;
    const std::lock_guard lock(mutex_);
    events_.push_back(event);
}

void Trace::addSpan(std::string_view name, Clock::time_point start, Clock::time_point end) {
    const std::lock_guard lock(mutex_);
    events_.push_back({name, nanoseconds(start - origin_), nanoseconds(end - start), 0});
}

std::size_t Trace::size() const {
    const std::lock_guard lock(mutex_);
    return events_.size();
}

std::string Trace::json() const {
    using Json = nlohmann::ordered_json;
    const std::lock_guard lock(mutex_);
    Json list = Json::array();
    std::set<unsigned> threads;
    for (const Event& event : events_) {
        Json e{{"name", event.name},
               {"ph", "X"},
               {"pid", 1},
               {"tid", event.thread},
               {"ts", static_cast<double>(event.start) / 1000},
               {"dur", static_cast<double>(event.duration) / 1000}};
        if (event.level >= 0) {
            e["args"] = {{"level", event.level},
                         {"tx", event.tx},
                         {"ty", event.ty},
                         {"changed", event.changed}};
        }
        if (event.failed) e["args"]["failed"] = true;
        threads.insert(event.thread);
        list.push_back(std::move(e));
    }
    for (const unsigned thread : threads) {
        const std::string name = thread == 0 ? "GL thread" : "worker " + std::to_string(thread);
        list.push_back({{"name", "thread_name"},
                        {"ph", "M"},
                        {"pid", 1},
                        {"tid", thread},
                        {"args", {{"name", name}}}});
    }
    return Json{{"traceEvents", std::move(list)}, {"displayTimeUnit", "ms"}}.dump();
}

} // namespace terrane
