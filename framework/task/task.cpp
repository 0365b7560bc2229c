// SPDX-License-Identifier: BSD-3-Clause
#include "task/task.h"

#include <algorithm>
#include <cassert>

namespace terrane {

Task::Task(Kind kind, std::string_view name, unsigned deadline)
    : kind_(kind)
    , name_(name)
    , firstDeadline_(deadline)
    , deadline_(deadline) {}

Task::~Task() {
    assert(job_ == kNone && "Task: destroyed while it is scheduled");
    clearPredecessors();
}

void Task::setDeadline(unsigned deadline) {
    unsigned current = deadline_.load(std::memory_order_relaxed);
    while (deadline < current && !deadline_.compare_exchange_weak(current, deadline)) {
    }
}

void Task::addPredecessor(std::shared_ptr<Task> earlier) {
    assert(earlier && earlier.get() != this && "Task::addPredecessor: not another task");
    if (!earlier || earlier.get() == this) return;
    if (std::find(predecessors_.begin(), predecessors_.end(), earlier) != predecessors_.end())
        return;
    earlier->dependents_.push_back(this);
    predecessors_.push_back(std::move(earlier));
    markUndone(Reason::dependencyChanged);
}

void Task::clearPredecessors() {
    for (const auto& earlier : predecessors_) {
        auto& list = earlier->dependents_;
        const auto self = std::find(list.begin(), list.end(), this);
        *self = list.back();
        list.pop_back();
    }
    predecessors_.clear();
}

void Task::markUndone(Reason reason) {
    if (!mark(reason)) return;
    std::vector<Task*> pending = dependents_;
    while (!pending.empty()) {
        Task* task = pending.back();
        pending.pop_back();
        if (task->mark(Reason::dependencyChanged))
            pending.insert(pending.end(), task->dependents_.begin(), task->dependents_.end());
    }
}

// Returns whether the dependents have to be told.
bool Task::mark(Reason reason) {
    const std::lock_guard lock(mutex_);
    if (reason != Reason::dependencyChanged) completionDate_ = 0;
    if (reason == Reason::dataNeeded) {
        // A task that is not done produces its data anyway, perhaps right now.
        if (done_) ++marks_;
        done_ = false;
        return false;
    }
    ++marks_;
    if (reason == Reason::dataChanged) ++dataMarks_;
    done_ = false;
    const bool told = stale_;
    stale_ = true;
    return !told;
}

Task::Ticket Task::ticket() const {
    const std::lock_guard lock(mutex_);
    return marks_;
}

Task::Start Task::start(Ticket ticket, bool tainted) {
    const std::lock_guard lock(mutex_);
    dataMarksAtStart_ = dataMarks_;
    if (completionDate_ < predecessorsDate_) return Start::run;
    return settle(ticket, tainted) ? Start::skipped : Start::skippedUndone;
}

bool Task::complete(Date now, bool changed, bool failed, Ticket ticket, bool tainted) {
    const std::lock_guard lock(mutex_);
    failed_ = failed;
    if (changed) changeDate_ = now;
    // Data that changed during the run may not have been seen: the date stays 0, it runs again.
    if (changed && dataMarks_ == dataMarksAtStart_) completionDate_ = now;
    return settle(ticket, tainted);
}

bool Task::settle(Ticket ticket, bool tainted) {
    if (tainted || ticket != marks_) return false;
    stale_ = false;
    deadline_ = firstDeadline_;
    done_.store(true, std::memory_order_release);
    return true;
}

void Task::raisePredecessorsDate(Date date) {
    const std::lock_guard lock(mutex_);
    if (date > predecessorsDate_) predecessorsDate_ = date;
}

} // namespace terrane
