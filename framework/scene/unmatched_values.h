// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class SceneManager;

/// Warns ("unmatched-uniform") of values of nodes whose ids no shader mentions. Those that name
/// textures are left out: a node may keep one to draw into. All modules must have been loaded,
/// those of methods that no frame calls, too.
void reportUnmatchedValues(SceneManager& scene);

} // namespace terrane
