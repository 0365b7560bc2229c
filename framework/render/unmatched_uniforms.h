// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/source.h"

#include <string>
#include <vector>

namespace terrane {

class ResourceManager;

/// Warns ("unmatched-uniform") of initial values of modules whose uniform none of the texts that
/// the module is linked with ever mentions: its name is misspelt. One that is mentioned, but
/// optimised away, is fine, and so is a module that no program has. GL thread.
void reportUnmatchedUniforms(ResourceManager& manager);

/// A value that somebody will hand to the uniforms of its name.
struct NamedValue {
    std::string name;
    Place place;
};

/// Warns ("unmatched-uniform") of values whose names no program has and no module mentions. All
/// modules must have been loaded.
void reportUnmatchedValues(ResourceManager& manager, const std::vector<NamedValue>& values);

} // namespace terrane
