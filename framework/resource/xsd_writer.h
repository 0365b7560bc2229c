// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/schema.h"

#include <string>

namespace terrane {

/// The grammar of archives in XML Schema 1.0, for editors and validators. Beside what Schema says,
/// XSD 1.0 can't count children of a rule where several rules count, nor ask for one of two
/// spellings of a required attribute.
std::string writeXsd(const Schema& schema);

} // namespace terrane
