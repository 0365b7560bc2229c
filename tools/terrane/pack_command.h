// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/registry.h"

#include <filesystem>
#include <iosfwd>
#include <vector>

/// What `terrane pack --help` says beside the options.
inline constexpr const char* kPackFooter =
    R"(Packs the archive with all that its names lead to, in its folder, the folders of --path and the
folders beside: XML files, shaders and what they include, textures, meshes, data, program binaries.
What comes with Terrane is left out, unless the archive has its own. Everything keeps the name that
led to it; files from other folders stand next to the archive.

The zip plays as the archive does, without being unpacked: large files and data are stored as they
are and read in place. The same files make the same bytes. An archive with errors is not packed.

Examples:
  terrane pack archives/mountains mountains.zip
  terrane pack alps --path ~/data alps.zip
  terrane play mountains.zip
  terrane check mountains.zip)";

/// Packs an archive and lists what is in the zip. Returns the exit status.
/// @param told whether the list is wanted
int packCommand(const terrane::Registry& registry, const std::filesystem::path& archive,
                const std::vector<std::filesystem::path>& paths,
                const std::filesystem::path& output, bool told, std::ostream& out,
                std::ostream& err);
