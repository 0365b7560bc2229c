// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/registry.h"

#include <iosfwd>
#include <string>

/// Makes a folder with a small working archive, and with the schemas by which editors complete and
/// check it. Overwrites nothing. Returns the exit status.
int makeNewArchive(const terrane::Registry& registry, const std::string& name, std::ostream& out,
                   std::ostream& err);
