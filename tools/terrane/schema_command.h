// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/registry.h"

#include <filesystem>
#include <iosfwd>
#include <string>

/// Writes the schema of archives ("xsd" or "rnc") or the reference manual ("md"): to a file, or of
/// the manual a folder, or else to `out`. Returns the exit status.
int writeSchema(const terrane::Registry& registry, const std::string& format,
                const std::filesystem::path& output, std::ostream& out, std::ostream& err);
