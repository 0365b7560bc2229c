// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace terrane {

class ResourceManager;
struct ResourceEntry;

/// Warns ("unused-resource") of each entry of the archives that none of the roots needs, directly
/// or through others; without a root, of each that nothing names. Entries of types that are not
/// built yet are passed over. All entries must have been loaded. Linear in their number.
/// @param roots may hold null
void reportUnusedResources(ResourceManager& manager, const std::vector<ResourceEntry*>& roots);

} // namespace terrane
