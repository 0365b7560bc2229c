// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"

#include <cstddef>
#include <deque>
#include <string>

namespace terrane {

/// The newest diagnostics of a player, a line each, for showLog. Lines appear once there is a
/// warning or an error and stay until somebody hides them; the next warning shows them again.
class MessageLog {
public:
    static constexpr std::size_t kMostLines = 256;

    struct Line {
        Severity severity;
        std::string text;
    };

    /// Whether the lines are to be seen. Hosts toggle it, the original's with F1.
    bool visible = false;

    /// Takes over what is new. Cheap when nothing is.
    void update(const Diagnostics& diagnostics);
    /// Oldest first.
    const std::deque<Line>& lines() const { return lines_; }

private:
    std::deque<Line> lines_;
    std::size_t seen_ = 0; ///< diagnostics taken over, of all that were ever reported
};

} // namespace terrane
