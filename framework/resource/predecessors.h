// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/description.h"

#include <vector>

namespace terrane {

/// Which of the nested elements of an earlier version of an element each of a new one continues:
/// one that says the same, else one of the same type with the same id or name. Null for those that
/// are new.
std::vector<const Child*> predecessors(const ElementDescription* before,
                                       const ElementDescription& now);

} // namespace terrane
