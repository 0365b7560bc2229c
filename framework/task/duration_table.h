// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace terrane {

/// How long tasks of a class take, learnt from those that ran. Not thread-safe.
class DurationTable {
public:
    /// @param seconds of a task of this class name and complexity
    void record(std::string_view name, int complexity, double seconds);

    /// Seconds: (mean + 2 sigma) x complexity without the shortest and the longest sample; 0 until
    /// there are kSamples of the class (Ork reference 5.1).
    double expected(std::string_view name, int complexity) const;

    static constexpr std::size_t kSamples = 64;

private:
    struct Row {
        std::string_view name;
        std::size_t count = 0;
        double sum = 0, sumOfSquares = 0; // of seconds per unit of complexity
        double shortest = 0, longest = 0;
    };
    std::vector<Row> rows_; // a program has a few dozen classes of tasks
};

} // namespace terrane
