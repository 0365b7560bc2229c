// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace terrane {

class Registry;

/// A file of a packed archive.
struct PackedFile {
    std::string name;           ///< in the zip
    std::filesystem::path path; ///< where it was found
    std::uint64_t size = 0;     ///< unpacked, bytes
};

struct PackResult {
    std::vector<Diagnostic> diagnostics; ///< as of checkArchive()
    std::vector<PackedFile> files;       ///< sorted by name
    std::size_t builtIn = 0; ///< files of Terrane's own that it uses; every player has them
    std::uint64_t size = 0;  ///< of the zip, bytes; 0: nothing was written
};

/// Packs an archive with all that its entries name, used or not, into one zip that plays as the
/// archive does: XML files that names lead to, shaders with their includes, textures, meshes,
/// data, and binaries of programs. What was found in other search folders goes next to the archive,
/// under the name that led there, which finds it as before. What is read in pieces, such as
/// pyramids, is stored, and read in place.
///
/// Writes nothing, with a diagnostic, when the archive has errors, when names differ in their case
/// alone ("pack-collision"), when the zip would play another archive ("pack-ambiguous"), and when
/// it can't be written ("pack-failed"). Data that is not prepared yet is left out; the script that
/// makes it comes along. The same files make the same bytes.
PackResult packArchive(const Registry& registry, const std::filesystem::path& archive,
                       const std::vector<std::filesystem::path>& paths,
                       const std::filesystem::path& output);

} // namespace terrane
