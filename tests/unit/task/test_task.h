// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "task/task.h"

#include <functional>
#include <memory>
#include <string_view>
#include <utility>

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

} // namespace terrane
