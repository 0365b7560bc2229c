// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "task/task.h"

#include <memory>
#include <vector>

namespace terrane {

/// The work of one frame: tasks and the order among them. Kept and cleared every frame, so that a
/// steady frame allocates nothing. Owner thread only.
///
///     graph.clear();
///     TaskGraph::Node last;
///     for (const auto& task : sequence)
///         last = graph.addAfter(task, last);
///     scheduler.run(graph);
///
/// Inputs (Task::addPredecessor) come along by themselves. A dependency added here orders two tasks
/// in this graph and says nothing about their data: no dates pass along it.
class TaskGraph {
public:
    /// A task in a graph; valid until the graph is cleared. False for a task with nothing to do.
    class Node {
    public:
        Node() = default;
        explicit operator bool() const { return index_ != Task::kNone; }
        bool operator==(const Node&) const = default;

    private:
        friend class TaskGraph;
        explicit Node(std::uint32_t index)
            : index_(index) {}
        std::uint32_t index_ = Task::kNone;
    };

    /// Adds a task that isn't done, and its inputs that aren't, transitively. A task that is here
    /// already isn't added twice. A done task is not added (false node), unless it is an everyFrame
    /// one, which runs again. What is marked undone after this call counts from the next graph on.
    Node add(const std::shared_ptr<Task>& task);

    /// An empty node, to order groups: one that comes after a group and before the next.
    Node join();

    /// `later` starts when `earlier` has ended. A false node is ignored.
    void addDependency(Node later, Node earlier);

    /// The next one in a sequence: adds `task` after `earlier`; returns `earlier` itself when there
    /// is nothing to do, so that a sequence goes on from there.
    Node addAfter(const std::shared_ptr<Task>& task, Node earlier);

    Node find(const Task& task) const;
    bool empty() const { return members_.empty(); }
    /// Tasks and joins.
    std::size_t size() const { return members_.size(); }
    /// Releases the tasks, keeps the memory.
    void clear();

    // What follows is for schedulers.

    struct Member {
        std::shared_ptr<Task> task; ///< null for a join
        Task::Ticket ticket = 0;    ///< taken when it was added
    };
    struct Edge {
        std::uint32_t later;
        std::uint32_t earlier;
        bool input; ///< `earlier` is an input of `later`
    };
    const std::vector<Member>& members() const { return members_; }
    const std::vector<Edge>& edges() const { return edges_; }

private:
    Node append(const std::shared_ptr<Task>& task);

    std::vector<Member> members_;
    std::vector<Edge> edges_;
};

} // namespace terrane
