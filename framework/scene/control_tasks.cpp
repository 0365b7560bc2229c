// SPDX-License-Identifier: BSD-3-Clause
#include "scene/control_tasks.h"

#include "resource/registry.h"
#include "scene/bind_context.h"
#include "scene/frame_builder.h"
#include "scene/scene_manager.h"
#include "scene/scene_task.h"

namespace terrane {

namespace {

using Tasks = std::vector<std::shared_ptr<SceneTask>>;

Tasks nestedTasks(const ElementDescription& description) {
    Tasks tasks;
    for (const Child& child : description.children) {
        if (auto task = child.built<SceneTask>()) tasks.push_back(std::move(task));
    }
    return tasks;
}

class BoundSequence : public BoundTask {
public:
    BoundSequence(const Tasks& tasks, BindContext& context) {
        for (const auto& task : tasks) {
            if (auto step = task->bind(context)) steps_.push_back(std::move(step));
        }
    }
    void emit(FrameBuilder& frame) override {
        for (const auto& step : steps_)
            step->emit(frame);
    }

private:
    std::vector<std::unique_ptr<BoundTask>> steps_;
};

struct SequenceDescription : ElementDescription {};

/// Its tasks, one after the other. One that can't be bound is left out.
class Sequence : public SceneTask {
public:
    explicit Sequence(const ElementDescription& description)
        : tasks_(nestedTasks(description)) {}
    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        return std::make_unique<BoundSequence>(tasks_, context);
    }

private:
    Tasks tasks_;
};

struct ForeachDescription : ElementDescription {
    Attr<std::string> var;
    Attr<std::string> flag;
    Attr<bool> culling = false;
    Attr<bool> parallel = false;
};

class BoundForeach : public BoundTask {
public:
    BoundForeach(const ForeachDescription& d, const Tasks& tasks, BindContext& context)
        : culling_(d.culling)
        , parallel_(d.parallel) {
        for (SceneNode* node : context.scene().ask(*d.flag, d.flag.place)) {
            if (!context.count(d.place)) break;
            context.setVariable(*d.var, node);
            iterations_.push_back({node, std::make_unique<BoundSequence>(tasks, context)});
        }
    }

    void emit(FrameBuilder& frame) override {
        if (!parallel_) {
            for (const Iteration& iteration : iterations_)
                emit(iteration, frame);
            return;
        }
        const FrameBuilder::Fork fork = frame.beginFork();
        for (const Iteration& iteration : iterations_) {
            emit(iteration, frame);
            frame.endBranch(fork);
        }
        frame.endFork(fork);
    }

private:
    struct Iteration {
        SceneNode* node;
        std::unique_ptr<BoundTask> body;
    };

    void emit(const Iteration& iteration, FrameBuilder& frame) const {
        if (culling_ && iteration.node->visibility == Visibility::none) return;
        iteration.body->emit(frame);
    }

    bool culling_;
    bool parallel_;
    std::vector<Iteration> iterations_;
};

/// Its tasks, once for each node with a flag, in document order.
class Foreach : public SceneTask {
public:
    explicit Foreach(const ForeachDescription& description)
        : description_(description)
        , tasks_(nestedTasks(description)) {}
    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        return std::make_unique<BoundForeach>(description_, tasks_, context);
    }

private:
    ForeachDescription description_;
    Tasks tasks_;
};

struct CallMethodDescription : ElementDescription {
    Attr<Target> method;
};

class BoundCall : public BoundTask {
public:
    BoundCall(const NodeMethod& method, std::unique_ptr<BoundTask> body)
        : method_(method)
        , body_(std::move(body)) {}
    void emit(FrameBuilder& frame) override {
        if (method_.enabled) body_->emit(frame);
    }

private:
    const NodeMethod& method_;
    std::unique_ptr<BoundTask> body_;
};

/// Runs a method of a node, with that node as `this`.
class CallMethod : public SceneTask {
public:
    explicit CallMethod(const CallMethodDescription& description)
        : name_(description.method) {}

    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        SceneNode* const node = name_->node.empty() ? nullptr : context.findNode(name_->node);
        if (!node) {
            context.diagnostics().report(
                {.code = "unknown-target",
                 .place = name_.place,
                 .message = name_->node.empty()
                                ? "'" + name_->name + "' names no node"
                                : "no node matches the target '" + name_->node + "'",
                 .expected = "'this.method', '$variable.method' or 'flag.method'",
                 .suggestion = context.suggestTarget(*name_)});
            return nullptr;
        }
        const auto method = node->methods.find(name_->name);
        if (method == node->methods.end()) {
            context.reportMissing(name_, *node, "method", node->methods);
            return nullptr;
        }
        if (!method->second.task) return nullptr; // told at the node
        if (!context.count(name_.place)) return nullptr;
        const BindContext::Call call(context, *node, name_->name);
        if (!call) {
            context.diagnostics().error("cycle", name_.place,
                                        "method '" + name_->name +
                                            "' calls itself, or is called through too many others");
            return nullptr;
        }
        auto body = method->second.task->bind(context);
        if (!body) return nullptr;
        return std::make_unique<BoundCall>(method->second, std::move(body));
    }

private:
    Attr<Target> name_;
};

} // namespace

void declareControlTasks(Registry& registry) {
    registry.nameInterface<SceneTask>("a task");
    registry
        .resource<Sequence, SequenceDescription, SceneTask>("sequence",
                                                            "Runs tasks one after the other.")
        .example(R"(<sequence name="drawGround">
    <setProgram><module name="this.material"/></setProgram>
    <drawTerrain name="this.terrain" mesh="this.grid" culling="true"/>
</sequence>)")
        .children<SceneTask>("the tasks, in order")
        .build([](const SequenceDescription& d, BuildContext&) {
            return std::make_shared<Sequence>(d);
        });

    using F = ForeachDescription;
    registry.resource<Foreach, F, SceneTask>("foreach", "Runs tasks for each node that has a flag.")
        .example(R"(<foreach name="drawObjects" var="o" flag="object" culling="true">
    <callMethod name="$o.draw"/>
</foreach>)")
        .attribute("var", &F::var,
                   "name of a variable that stands for the node in turn: with 'o', tasks in the "
                   "loop say '$o.draw'")
        .required()
        .attribute("flag", &F::flag, "flag, or name, of the nodes")
        .required()
        .attribute("culling", &F::culling, "leaves out nodes that the camera can't see")
        .attribute("parallel", &F::parallel,
                   "the tasks of different nodes may run in any order, and at once")
        .children<SceneTask>("the tasks, in order")
        .build([](const F& d, BuildContext&) { return std::make_shared<Foreach>(d); });

    using C = CallMethodDescription;
    registry.resource<CallMethod, C, SceneTask>("callMethod", "Runs a method of a node.")
        .attribute("name", &C::method,
                   "the node, and the key of its method: 'this.draw', '$o.draw', 'camera.draw'")
        .required()
        .build([](const C& d, BuildContext&) { return std::make_shared<CallMethod>(d); });
}

} // namespace terrane
