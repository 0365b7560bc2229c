// SPDX-License-Identifier: BSD-3-Clause
#include "task/task_graph.h"

#include <cassert>

namespace terrane {

TaskGraph::Node TaskGraph::find(const Task& task) const {
    // The task remembers where it was put last; what stands there tells whether that is still so.
    const std::uint32_t index = task.graphIndex_;
    const bool here = index < members_.size() && members_[index].task.get() == &task;
    return here ? Node(index) : Node();
}

TaskGraph::Node TaskGraph::append(const std::shared_ptr<Task>& task) {
    if (const Node node = find(*task)) return node;
    if (task->everyFrame()) task->rearm();
    if (task->done()) return {};
    task->prepare();
    task->graphIndex_ = static_cast<std::uint32_t>(members_.size());
    members_.push_back({task, task->ticket()});
    return Node(task->graphIndex_);
}

TaskGraph::Node TaskGraph::add(const std::shared_ptr<Task>& task) {
    assert(task && "TaskGraph::add: no task");
    const std::size_t known = members_.size();
    const Node node = append(task);
    // New members are appended behind, until all inputs have been looked at.
    for (std::size_t i = known; i < members_.size(); ++i) {
        const Task& later = *members_[i].task;
        for (const auto& input : later.predecessors())
            if (const Node earlier = append(input))
                edges_.push_back({static_cast<std::uint32_t>(i), earlier.index_, true});
    }
    return node;
}

TaskGraph::Node TaskGraph::join() {
    members_.emplace_back();
    return Node(static_cast<std::uint32_t>(members_.size() - 1));
}

void TaskGraph::addDependency(Node later, Node earlier) {
    if (!later || !earlier) return;
    assert(later.index_ < size() && earlier.index_ < size() && "TaskGraph: node of another graph");
    edges_.push_back({later.index_, earlier.index_, false});
}

TaskGraph::Node TaskGraph::addAfter(const std::shared_ptr<Task>& task, Node earlier) {
    const Node node = add(task);
    if (!node) return earlier;
    addDependency(node, earlier);
    return node;
}

void TaskGraph::clear() {
    members_.clear();
    edges_.clear();
}

} // namespace terrane
