// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class ResourceManager;

/// Warns ("unmatched-uniform") of initial values of modules whose uniform none of the texts that
/// the module is linked with ever mentions: its name is misspelt. One that is mentioned, but
/// optimised away, is fine, and so is a module that no program has. GL thread.
void reportUnmatchedUniforms(ResourceManager& manager);

} // namespace terrane
