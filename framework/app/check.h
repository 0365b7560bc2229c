// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"

#include <filesystem>
#include <string>
#include <vector>

namespace terrane {

class Registry;

/// Loads every entry of an archive, used or not, and builds the task graph of one frame, without a
/// display. What is wrong is returned sorted by file and position; what has no place comes first.
/// @param unused whether entries that nothing which is played uses are told, too
std::vector<Diagnostic> checkArchive(const Registry& registry, const std::filesystem::path& archive,
                                     const std::vector<std::filesystem::path>& paths,
                                     bool unused = false);

/// Sorts as people want to read it: by file, then by position, then by code and message, so that
/// the order does not depend on which thread came first.
void sortByPlace(std::vector<Diagnostic>& diagnostics);

/// For programs: a list of {severity, code, file, line, column, message, expected, suggestion,
/// detail, chain}; what is empty is left out. docs/diagnostics.md tells what they are.
std::string toJson(const std::vector<Diagnostic>& diagnostics);

struct DiagnosticCounts {
    int errors = 0, warnings = 0;
    int skipped = 0;              ///< for data that is not prepared
    std::string toString() const; ///< "2 errors, 1 warning"
};
DiagnosticCounts count(const std::vector<Diagnostic>& diagnostics);

} // namespace terrane
