// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

/// Makes a folder with a small working archive. Returns the exit status.
int makeNewArchive(const std::string& name, std::ostream& out, std::ostream& err);
