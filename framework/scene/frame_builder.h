// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "task/task_graph.h"

#include <memory>

namespace terrane {

/// Builds the task graph of one frame in the order of the methods: what is added comes after what
/// was added before. Allocates nothing in a steady frame.
class FrameBuilder {
public:
    explicit FrameBuilder(TaskGraph& graph)
        : graph_(graph) {}

    /// The next task in the sequence.
    void add(const std::shared_ptr<Task>& task) {
        settle();
        tail_ = graph_.addAfter(task, tail_);
        if (forks_ > 0 && task->kind() == Task::Kind::gpu) keepDrawOrder();
    }

    /// A task, such as one that makes a tile, that has to be done before whatever is added next. It
    /// may start at once.
    void require(const std::shared_ptr<Task>& task) {
        const TaskGraph::Node node = graph_.add(task);
        if (!node) return;
        if (!gate_) {
            gate_ = graph_.join();
            graph_.addDependency(gate_, tail_);
        }
        graph_.addDependency(gate_, node);
    }

    /// Branches without order among them: begin, then for each branch endBranch(), then end. They
    /// nest. Only tasks of the GL thread stay in the order in which they were added: program and
    /// state that one branch sets must not be those that another draws with.
    struct Fork {
        TaskGraph::Node start, end;
    };
    Fork beginFork() {
        settle();
        if (forks_++ == 0) lastDraw_ = {};
        return {tail_, graph_.join()};
    }
    void endBranch(const Fork& fork) {
        settle();
        graph_.addDependency(fork.end, tail_);
        tail_ = fork.start;
    }
    void endFork(const Fork& fork) {
        graph_.addDependency(fork.end, fork.start);
        tail_ = fork.end;
        --forks_;
    }

private:
    void settle() {
        if (gate_) tail_ = gate_;
        gate_ = {};
    }

    void keepDrawOrder() {
        if (lastDraw_ != tail_) graph_.addDependency(tail_, lastDraw_);
        lastDraw_ = tail_;
    }

    TaskGraph& graph_;
    TaskGraph::Node tail_;
    TaskGraph::Node gate_;     ///< waits for the tail and for what was required since
    TaskGraph::Node lastDraw_; ///< of the GL thread, since the outermost fork began
    int forks_ = 0;
};

} // namespace terrane
