// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace terrane {

/// What came of a reload.
struct ReloadReport {
    bool changed = false;             ///< there was something to do
    bool good = true;                 ///< false: there are errors, and the picture stays as it was
    std::vector<std::string> rebuilt; ///< names of the resources, in alphabetical order
    std::map<std::string, int> tilesInvalidated; ///< tiles that were there, by producer
    double milliseconds = 0; ///< until the next frame could start; compilers included
};

} // namespace terrane
