// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/fixture.h"

#include <filesystem>
#include <iosfwd>
#include <vector>

namespace terrane {

/// Runs all fixtures at or below some paths, each in a process of its own, so that one that crashes
/// or hangs fails alone, and prints a report. To be called before OpenGL is used in this process,
/// and without other threads.
///
/// `options.output` gets a folder for each fixture.
/// @return the exit status: 0 when none failed, 2 when there is none to run
int testFixtures(const Registry& registry, const std::vector<std::filesystem::path>& paths,
                 const FixtureOptions& options, std::ostream& out);

} // namespace terrane
