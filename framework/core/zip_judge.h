// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/zip_file.h"

#include <vector>

namespace terrane {

struct ZipDirectory;

/// The files that a zip's directory speaks of, sorted by name, after every check that ZipFile
/// promises; faults are reported, each with the zip's name. Nothing of a refused zip is returned.
/// @param name of the zip, for messages
std::vector<ZipFile::Entry> judgeZip(const RandomAccessFile& file, const ZipDirectory& directory,
                                     const std::string& name, Diagnostics& diagnostics);

} // namespace terrane
