// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/file_tree.h"

#include <filesystem>
#include <string>
#include <vector>

namespace terrane {

/// A file that is to be packed.
struct ZipContent {
    std::string name; ///< in the zip
    std::filesystem::path path;
    bool stored = false; ///< as it is, to be read in place; else deflated
};

/// Writes a zip beside the path and renames, so that nobody ever sees half of one. The same files
/// make the same bytes, whenever they were written. False, with the reason, on failure.
/// @param files where the contents are, which are read piece by piece
bool writeZip(const std::filesystem::path& path, const std::vector<ZipContent>& contents,
              const FileTree& files, std::string& problem);

} // namespace terrane
