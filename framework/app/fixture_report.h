// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/fixture.h"

#include <filesystem>
#include <string>
#include <vector>

namespace terrane {

/// A fixture that was run.
struct FixtureCase {
    std::filesystem::path folder;
    FixtureResult result;
    double seconds = 0;
};

/// The results as JUnit's XML, which build servers read: one suite, a case for each fixture.
std::string junitReport(const std::vector<FixtureCase>& cases);

} // namespace terrane
