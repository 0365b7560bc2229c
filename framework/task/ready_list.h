// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <vector>

namespace terrane {

/// Which of two ready jobs goes first: deadline, context, expected duration, order of insertion.
struct JobKey {
    unsigned deadline = 0;
    unsigned context = 0; ///< number of the context, 0 = none, in the order they were first met
    double duration = 0;  ///< expected seconds
    std::uint64_t order = 0;

    auto operator<=>(const JobKey&) const = default;
};

/// Jobs whose predecessors have ended, the first to go at the back.
class ReadyList {
public:
    struct Entry {
        JobKey key;
        std::uint32_t job;
    };

    bool empty() const { return entries_.empty(); }
    std::size_t size() const { return entries_.size(); }
    const Entry& first() const { return entries_.back(); }
    void reserve(std::size_t count) { entries_.reserve(count); }
    void clear() { entries_.clear(); }

    void insert(const JobKey& key, std::uint32_t job) {
        entries_.insert(position(key), Entry{key, job});
    }
    void remove(const JobKey& key) { entries_.erase(position(key)); }

    /// The first of this deadline and context; null when there is none.
    const Entry* firstOf(unsigned deadline, unsigned context) const {
        const auto end = std::partition_point(entries_.begin(), entries_.end(), [&](auto& entry) {
            const JobKey& key = entry.key;
            return key.deadline != deadline ? key.deadline > deadline : key.context >= context;
        });
        if (end == entries_.begin()) return nullptr;
        const Entry& entry = *(end - 1);
        return entry.key.deadline == deadline && entry.key.context == context ? &entry : nullptr;
    }

private:
    std::vector<Entry>::iterator position(const JobKey& key) {
        return std::partition_point(entries_.begin(), entries_.end(),
                                    [&](auto& entry) { return entry.key > key; });
    }

    std::vector<Entry> entries_;
};

} // namespace terrane
