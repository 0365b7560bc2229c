// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/source.h"

namespace terrane {

/// The place of an attribute's name, given that of its value (Attr::place): for rules that find an
/// attribute out of place, whatever its value. The same place when no attribute is written there.
Place attributeName(const Place& value);

} // namespace terrane
