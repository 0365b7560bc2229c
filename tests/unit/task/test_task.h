// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "task/task.h"

#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terrane {

/// A task that calls a function and counts its runs.
class TestTask : public Task {
public:
    using Function = std::function<bool()>;

    TestTask(Kind kind, Function function, std::string_view name = "Test",
             unsigned deadline = kImmediate)
        : Task(kind, name, deadline)
        , function_(std::move(function)) {}

    bool run() override {
        ++runs;
        return function_ ? function_() : true;
    }
    const void* context() const override { return sharedContext; }
    void begin() override {
        if (onBegin) onBegin();
    }
    void end() override {
        if (onEnd) onEnd();
    }

    int runs = 0;
    const void* sharedContext = nullptr;
    std::function<void()> onBegin, onEnd;

private:
    Function function_;
};

inline std::shared_ptr<TestTask> cpuTask(TestTask::Function function = {},
                                         std::string_view name = "Test",
                                         unsigned deadline = Task::kImmediate) {
    return std::make_shared<TestTask>(Task::Kind::cpu, std::move(function), name, deadline);
}

inline std::shared_ptr<TestTask> gpuTask(TestTask::Function function = {},
                                         std::string_view name = "Test",
                                         unsigned deadline = Task::kImmediate) {
    return std::make_shared<TestTask>(Task::Kind::gpu, std::move(function), name, deadline);
}

using Names = std::vector<std::string>;

/// Tasks that write down their names in the order in which they run.
struct Log {
    std::mutex mutex;
    Names names;

    void write(std::string name) {
        const std::lock_guard lock(mutex);
        names.push_back(std::move(name));
    }
    Names take() { return std::exchange(names, {}); }
    std::shared_ptr<TestTask> task(Task::Kind kind, std::string name,
                                   unsigned deadline = Task::kImmediate) {
        return std::make_shared<TestTask>(
            kind, [this, name] { return write(name), true; }, "Logged", deadline);
    }
    std::shared_ptr<TestTask> cpu(std::string name, unsigned deadline = Task::kImmediate) {
        return task(Task::Kind::cpu, std::move(name), deadline);
    }
    std::shared_ptr<TestTask> gpu(std::string name, unsigned deadline = Task::kImmediate) {
        return task(Task::Kind::gpu, std::move(name), deadline);
    }
    std::shared_ptr<TestTask> gpuIn(const int& context, std::string name) {
        auto made = gpu(name);
        made->sharedContext = &context;
        made->onBegin = [this, name] { write("begin " + name); };
        made->onEnd = [this, name] { write("end " + name); };
        return made;
    }
};

/// The workers that each row of a table is run with.
template <class Test>
void withWorkers(Test test) {
    for (const unsigned workers : {0u, 1u, 2u, 4u}) {
        CAPTURE(workers);
        test(workers);
    }
}

} // namespace terrane
