// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/options.h"

#include <filesystem>
#include <iosfwd>

namespace terrane {

class Registry;

/// The least serious message that is told.
enum class LogLevel { debug, info, warning, error };

/// A run from start to end: what `terrane play` does.
struct RunOptions {
    PlayerOptions player;
    bool window = false; ///< show the frames in one, until a person closes it
    /// Negative: until the picture is complete, or the window closed; ignored with a script.
    int frames = -1;
    std::filesystem::path script; ///< "-" reads lines as they arrive and answers each
    LogLevel logLevel = LogLevel::info;
    std::filesystem::path screenshot, metrics, trace; ///< empty: not written
};

/// What it talks to: lines of an interactive script, its answers, and messages for people.
struct RunStreams {
    std::istream& in;
    std::ostream& out;
    std::ostream& err;
};

/// The exit status: 0 fine, 1 the archive or the run failed.
int run(const Registry& registry, const RunOptions& options, const RunStreams& streams);

} // namespace terrane
