// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/resource.h"
#include "task/task.h"

#include <memory>
#include <string_view>

namespace terrane {

class BindContext;
class FrameBuilder;

/// A task bound to the nodes that it works on. Belongs to the frame plan of a SceneManager.
class BoundTask {
public:
    BoundTask() = default;
    BoundTask(const BoundTask&) = delete;
    BoundTask& operator=(const BoundTask&) = delete;
    virtual ~BoundTask() = default;

    /// Adds the work of this frame. Called every frame on the GL thread; looks nothing up by name
    /// and allocates nothing in a steady frame.
    virtual void emit(FrameBuilder& frame) = 0;
};

/// What a method does: <sequence>, <foreach>, <drawMesh>... A description of work; `bind` resolves
/// its targets for one node, once, when the plan of the frame is made.
class SceneTask : public Resource {
public:
    /// Null, with diagnostics, when a target can't be found: the rest of a sequence goes on without
    /// it.
    virtual std::unique_ptr<BoundTask> bind(BindContext& context) const = 0;
};

/// Work of the GL thread that is repeated every frame, such as a draw command.
class FrameTask : public Task {
public:
    explicit FrameTask(std::string_view name)
        : Task(Kind::gpu, name) {
        setEveryFrame(true);
    }
};

/// A BoundTask that adds one and the same task every frame.
class BoundStep : public BoundTask {
public:
    explicit BoundStep(std::shared_ptr<Task> task)
        : task_(std::move(task)) {}
    void emit(FrameBuilder& frame) override;

private:
    std::shared_ptr<Task> task_;
};

/// The bound form of a FrameTask made in place.
template <class T, class... Arguments>
std::unique_ptr<BoundTask> makeStep(Arguments&&... arguments) {
    return std::make_unique<BoundStep>(std::make_shared<T>(std::forward<Arguments>(arguments)...));
}

} // namespace terrane
