// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/schema.h"

#include <string>

namespace terrane {

/// The grammar of archives in the compact syntax of RELAX NG, as nxml-mode of Emacs reads it. Says
/// all that Schema says.
std::string writeRnc(const Schema& schema);

} // namespace terrane
