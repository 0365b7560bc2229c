// SPDX-License-Identifier: BSD-3-Clause
#include "task/duration_table.h"

#include <algorithm>
#include <cmath>

namespace terrane {

void DurationTable::record(std::string_view name, int complexity, double seconds) {
    auto row = std::find_if(rows_.begin(), rows_.end(), [&](auto& r) { return r.name == name; });
    if (row == rows_.end()) row = rows_.insert(row, Row{name});
    const double unit = seconds / complexity;
    row->shortest = row->count ? std::min(row->shortest, unit) : unit;
    row->longest = row->count ? std::max(row->longest, unit) : unit;
    row->sum += unit;
    row->sumOfSquares += unit * unit;
    ++row->count;
}

double DurationTable::expected(std::string_view name, int complexity) const {
    const auto row =
        std::find_if(rows_.begin(), rows_.end(), [&](auto& r) { return r.name == name; });
    if (row == rows_.end() || row->count < kSamples) return 0;
    const double count = static_cast<double>(row->count - 2);
    const double mean = (row->sum - row->shortest - row->longest) / count;
    const double squares =
        row->sumOfSquares - row->shortest * row->shortest - row->longest * row->longest;
    const double variance = std::max(0.0, squares / count - mean * mean);
    return (mean + 2 * std::sqrt(variance)) * complexity;
}

} // namespace terrane
