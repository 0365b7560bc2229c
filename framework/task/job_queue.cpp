// SPDX-License-Identifier: BSD-3-Clause
#include "task/job_queue.h"

#include <algorithm>
#include <cassert>

namespace terrane {

// --- adding ------------------------------------------------------------------------------------

void JobQueue::enqueue(const TaskGraph& graph, const DurationTable& durations) {
    const bool wasEmpty = empty();
    const std::uint64_t firstNew = nextOrder_;
    if (wasEmpty) contexts_.clear();

    memberJobs_.clear();
    for (const TaskGraph::Member& member : graph.members())
        memberJobs_.push_back(jobOf(member, durations));
    for (const TaskGraph::Edge& edge : graph.edges()) {
        const Index earlier = memberJobs_[edge.earlier], later = memberJobs_[edge.later];
        if (earlier != kNone && later != kNone) connect(earlier, later, edge.input);
    }
    if (!wasEmpty)
        for (const Index job : memberJobs_)
            if (job != kNone) guardDependents(job, firstNew);
    // A join that is ready ends at once, so that a job met here may be ready or free already.
    for (const Index job : memberJobs_)
        if (job != kNone && jobs_[job].state == State::blocked && jobs_[job].waiting == 0)
            makeReady(job);
}

JobQueue::Index JobQueue::jobOf(const TaskGraph::Member& member, const DurationTable& durations) {
    if (!member.task) return create(nullptr, 0, durations);
    Task& task = *member.task;
    if (task.done()) return kNone;
    // Inputs that are done push no date any more.
    for (const auto& input : task.predecessors())
        task.raisePredecessorsDate(input->changeDate());

    const Index known = task.job_;
    if (known == kNone) return create(member.task, member.ticket, durations);
    if (jobs_[known].state != State::running) {
        // Inputs that ended undone meanwhile are in the graph, too, and run again before.
        jobs_[known].tainted = false;
        jobs_[known].ticket = std::max(jobs_[known].ticket, member.ticket);
        lower(known, task.deadline());
        return known;
    }
    if (jobs_[known].ticket >= member.ticket) {
        lower(known, task.deadline());
        return known;
    }
    // It was marked undone while it runs: once more, after that. What waits for it gets its result
    // from then (see guardDependents), and is not spoilt by how the present run ends.
    for (Index edge = jobs_[known].firstOut; edge != kNone; edge = edges_[edge].nextOut)
        edges_[edge].input = false;
    const Index again = create(member.task, member.ticket, durations);
    connect(known, again, false);
    return again;
}

JobQueue::Index JobQueue::create(const std::shared_ptr<Task>& task, Task::Ticket ticket,
                                 const DurationTable& durations) {
    if (freeJobs_.empty()) {
        freeJobs_.push_back(static_cast<Index>(jobs_.size()));
        jobs_.emplace_back();
        // Whatever the interleaving, these need no more memory than this.
        cpu_.reserve(jobs_.capacity());
        gpu_.reserve(jobs_.capacity());
        joins_.reserve(jobs_.capacity());
        freeJobs_.reserve(jobs_.capacity());
    }
    const Index index = freeJobs_.back();
    freeJobs_.pop_back();
    Job& job = jobs_[index];
    job = {};
    job.task = task;
    job.ticket = ticket;
    job.state = State::blocked;
    job.key.order = nextOrder_++;
    job.key.deadline = Task::kWhenever;
    if (task) {
        job.key.deadline = task->deadline();
        job.key.duration = durations.expected(task->name(), task->complexity());
        if (task->kind() == Task::Kind::gpu) job.key.context = contextNumber(task->context());
        task->job_ = index;
    }
    ++count_;
    count(job, 1);
    return index;
}

unsigned JobQueue::contextNumber(const void* context) {
    if (!context) return 0;
    const auto known = std::find(contexts_.begin(), contexts_.end(), context);
    const auto number = static_cast<unsigned>(known - contexts_.begin() + 1);
    if (known == contexts_.end()) contexts_.push_back(context);
    return number;
}

// What runs or waits outside of the graph that `job` comes from may read the result of its task:
// that which runs must end first, that which waits must wait for the new result.
void JobQueue::guardDependents(Index job, std::uint64_t firstNew) {
    if (!jobs_[job].task || jobs_[job].state == State::running) return;
    for (const Task* dependent : jobs_[job].task->dependents()) {
        const Index queued = dependent->job_;
        if (queued == kNone) continue;
        const Index running = runningJobOf(*dependent);
        if (running != kNone) connect(running, job, false);
        if (running != queued && jobs_[queued].key.order < firstNew) connect(job, queued, true);
    }
}

JobQueue::Index JobQueue::runningJobOf(const Task& task) const {
    if (task.job_ == kNone || jobs_[task.job_].state == State::running) return task.job_;
    for (Index edge = jobs_[task.job_].firstIn; edge != kNone; edge = edges_[edge].nextIn) {
        const Job& job = jobs_[edges_[edge].from];
        if (job.task.get() == &task && job.state == State::running) return edges_[edge].from;
    }
    return kNone;
}

void JobQueue::connect(Index earlier, Index later, bool input) {
    Job& to = jobs_[later];
    if (to.state == State::running) return; // too late
    if (to.state == State::ready) block(later);

    if (freeEdges_.empty()) {
        freeEdges_.push_back(static_cast<Index>(edges_.size()));
        edges_.emplace_back();
        freeEdges_.reserve(edges_.capacity());
    }
    const Index index = freeEdges_.back();
    freeEdges_.pop_back();
    Job& from = jobs_[earlier];
    edges_[index] = {earlier, later, from.firstOut, kNone, to.firstIn, input};
    if (to.firstIn != kNone) edges_[to.firstIn].previousIn = index;
    from.firstOut = to.firstIn = index;
    ++to.waiting;
    lower(earlier, to.key.deadline);
}

// --- deadlines and order -----------------------------------------------------------------------

void JobQueue::lower(const Task& task, unsigned deadline) {
    if (task.job_ != kNone) lower(task.job_, deadline);
}

void JobQueue::lower(Index start, unsigned deadline) {
    lowering_.assign(1, start);
    while (!lowering_.empty()) {
        Job& job = jobs_[lowering_.back()];
        const Index index = lowering_.back();
        lowering_.pop_back();
        if (job.key.deadline <= deadline) continue;
        const bool ready = job.state == State::ready;
        if (ready) readyList(job).remove(job.key);
        count(job, -1);
        job.key.deadline = deadline;
        count(job, 1);
        if (ready) readyList(job).insert(job.key, index);
        for (Index edge = job.firstIn; edge != kNone; edge = edges_[edge].nextIn)
            lowering_.push_back(edges_[edge].from);
    }
}

JobQueue::Index JobQueue::best(const void* openContext, bool gpuFirst) const {
    if (gpu_.empty()) return bestCpu();
    const unsigned deadline = gpu_.first().key.deadline;
    const bool cpuToo = !cpu_.empty() && cpu_.first().key.deadline <= deadline;
    if (cpuToo && cpu_.first().key.deadline < deadline) return cpu_.first().job;

    if (openContext) {
        const auto known = std::find(contexts_.begin(), contexts_.end(), openContext);
        if (known != contexts_.end())
            if (auto* same =
                    gpu_.firstOf(deadline, static_cast<unsigned>(known - contexts_.begin() + 1)))
                return same->job;
    }
    const ReadyList::Entry& gpu = gpu_.first();
    if (!cpuToo) return gpu.job;
    if (gpu.key.context == 0 && gpuFirst) return gpu.job;
    return gpu.key < cpu_.first().key ? gpu.job : cpu_.first().job;
}

ReadyList& JobQueue::readyList(const Job& job) {
    return job.task->kind() == Task::Kind::gpu ? gpu_ : cpu_;
}

// --- from blocked to ready to running to ended -------------------------------------------------

void JobQueue::count(const Job& job, int change) {
    const auto n = static_cast<unsigned>(change);
    if (job.state == State::running) running_ += n;
    if (job.key.deadline == Task::kImmediate)
        immediate_ += n;
    else if (job.task && job.state != State::running)
        future_ += n;
}

void JobQueue::setState(Job& job, State state) {
    count(job, -1);
    job.state = state;
    count(job, 1);
}

void JobQueue::makeReady(Index index) {
    Job& job = jobs_[index];
    if (!job.task) {
        end(index, true);
        return;
    }
    setState(job, State::ready);
    readyList(job).insert(job.key, index);
}

void JobQueue::block(Index index) {
    Job& job = jobs_[index];
    readyList(job).remove(job.key);
    setState(job, State::blocked);
}

bool JobQueue::start(Index index) {
    Job& job = jobs_[index];
    assert(job.state == State::ready);
    readyList(job).remove(job.key);
    setState(job, State::running);
    const Task::Start start = job.task->start(job.ticket, job.tainted);
    if (start == Task::Start::run) return true;
    end(index, start == Task::Start::skipped);
    return false;
}

void JobQueue::finish(Index index, Task::Date now, bool changed, bool failed) {
    const Job& job = jobs_[index];
    const bool done = job.task->complete(now, changed, failed, job.ticket, job.tainted);
    end(index, done);
}

void JobQueue::end(Index index, bool done) {
    // Joins that become ready end too, one after the other rather than one inside the other.
    joins_.assign(1, index);
    for (std::size_t i = 0; i < joins_.size(); ++i) {
        releaseSuccessors(joins_[i], done);
        free(joins_[i]);
    }
}

void JobQueue::releaseSuccessors(Index index, bool done) {
    Index edge = jobs_[index].firstOut;
    while (edge != kNone) {
        const Edge released = edges_[edge];
        Job& later = jobs_[released.to];
        if (released.input) {
            later.task->raisePredecessorsDate(jobs_[index].task->changeDate());
            later.tainted |= !done;
        }
        unlinkIn(edge);
        freeEdges_.push_back(edge);
        if (later.waiting == 0) {
            if (later.task)
                makeReady(released.to);
            else
                joins_.push_back(released.to);
        }
        edge = released.nextOut;
    }
    jobs_[index].firstOut = kNone;
}

void JobQueue::unlinkIn(Index index) {
    const Edge& edge = edges_[index];
    Job& to = jobs_[edge.to];
    (edge.previousIn == kNone ? to.firstIn : edges_[edge.previousIn].nextIn) = edge.nextIn;
    if (edge.nextIn != kNone) edges_[edge.nextIn].previousIn = edge.previousIn;
    --to.waiting;
}

void JobQueue::unlinkOut(Index index) {
    Index* link = &jobs_[edges_[index].from].firstOut;
    while (*link != index)
        link = &edges_[*link].nextOut;
    *link = edges_[index].nextOut;
}

void JobQueue::free(Index index) {
    Job& job = jobs_[index];
    count(job, -1);
    --count_;
    job.state = State::free;
    if (job.task) {
        if (job.task->job_ == index) job.task->job_ = kNone;
        ended_.push_back(std::move(job.task));
    }
    freeJobs_.push_back(index);
}

void JobQueue::clear() {
    assert(running_ == 0);
    for (Job& job : jobs_)
        if (job.state != State::free && job.task) {
            job.task->job_ = kNone;
            ended_.push_back(std::move(job.task));
        }
    jobs_.clear();
    freeJobs_.clear();
    edges_.clear();
    freeEdges_.clear();
    cpu_.clear();
    gpu_.clear();
    count_ = immediate_ = future_ = running_ = 0;
}

// --- cycles ------------------------------------------------------------------------------------

// Everything that is left waits for something that is left, so that going back ends in a cycle.
JobQueue::Index JobQueue::onCycle(Index start) const {
    std::vector<bool> met(jobs_.size());
    while (!met[start]) {
        met[start] = true;
        start = edges_[jobs_[start].firstIn].from;
    }
    return start;
}

JobQueue::Cycle JobQueue::breakCycle() {
    // Begins with a task, so that there is one to name; of this frame if possible.
    const auto rank = [](const Job& job) {
        return job.state == State::free               ? 3
               : !job.task                            ? 2
               : job.key.deadline != Task::kImmediate ? 1
                                                      : 0;
    };
    const auto from = std::min_element(jobs_.begin(), jobs_.end(), [&](auto& a, auto& b) {
        return std::pair(rank(a), a.key.order) < std::pair(rank(b), b.key.order);
    });
    assert(from != jobs_.end() && from->state == State::blocked);

    Cycle cycle{from->task, {}};
    const Index any = onCycle(static_cast<Index>(from - jobs_.begin()));
    Index first = any, at = any;
    do { // the one that was added first is let go
        at = edges_[jobs_[at].firstIn].from;
        if (jobs_[at].key.order < jobs_[first].key.order) first = at;
    } while (at != any);

    const auto name = [&](Index job) {
        return jobs_[job].task ? std::string(jobs_[job].task->name()) : "(join)";
    };
    cycle.message = name(first);
    at = first;
    do {
        at = edges_[jobs_[at].firstIn].from;
        cycle.message = name(at) + " -> " + cycle.message;
        if (jobs_[at].task) cycle.task = jobs_[at].task;
    } while (at != first);
    cycle.message = "tasks wait for each other: " + cycle.message +
                    "; the last of these dependencies is ignored";

    const Index edge = jobs_[first].firstIn;
    unlinkOut(edge);
    unlinkIn(edge);
    freeEdges_.push_back(edge);
    if (jobs_[first].waiting == 0) makeReady(first);
    return cycle;
}

} // namespace terrane
