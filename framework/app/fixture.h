// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace terrane {

class Registry;

struct FixtureOptions {
    std::vector<std::filesystem::path> data; ///< folders of data, also searched for names
    std::filesystem::path output;            ///< for pictures of failures and screenshots
    bool updatePictures = false; ///< write the expected pictures anew where others are drawn
    std::filesystem::path junit; ///< where a report for build servers goes; empty: nowhere
};

struct FixtureResult {
    enum class Status { passed, failed, skipped };
    Status status = Status::passed;
    std::string report; ///< why it failed or was skipped, pictures that were updated; lines
};

/// Folders with a file `script` at or below a path, sorted.
std::vector<std::filesystem::path> findFixtures(const std::filesystem::path& path);

/// Runs one fixture: a folder with an archive and a script. It fails when a line of the script
/// does, and when an error is reported that no line expects. A script that only expects diagnostics
/// checks every entry of its archive, as `terrane check` does, and draws nothing; otherwise the
/// archive is played, in spite of errors if the script expects some.
FixtureResult runFixture(const Registry& registry, const std::filesystem::path& folder,
                         const FixtureOptions& options);

} // namespace terrane
