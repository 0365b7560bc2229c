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

    /// Branches without order among them: begin, then for each branch branch(), then end. They
    /// nest.
    struct Fork {
        TaskGraph::Node start, end;
    };
    Fork beginFork() {
        settle();
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
    }

private:
    void settle() {
        if (gate_) tail_ = gate_;
        gate_ = {};
    }

    TaskGraph& graph_;
    TaskGraph::Node tail_;
    TaskGraph::Node gate_; ///< waits for the tail and for what was required since
};

} // namespace terrane
