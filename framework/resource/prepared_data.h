// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/files.h"

#include <filesystem>
#include <optional>
#include <string>

namespace terrane {

/// Code of the note that data is not there yet.
inline constexpr const char* kDataNotPrepared = "data-not-prepared";

/// Data too large to come with an archive is made, or fetched, by a script that lies beside it: a
/// file `prepare` in a search folder. It names what it makes, one a line, in comments such as
///
///     # makes: DEM.dat
///     # makes: tiles/*.dat
///
/// where `*` stands for any characters. A file that is missing and that such a script makes is no
/// error of the archive: what needs it is skipped.
///
/// Returns the script that makes a file of this name; nothing when there is none.
std::optional<std::filesystem::path> preparingScript(const SearchPath& searchPath,
                                                     const std::string& name);

} // namespace terrane
