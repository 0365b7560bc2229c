// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class SceneManager;

/// Warns ("unknown-flag") of flags that are likely misspelt: of a loop or target, when no node has
/// it, and of a node, when no method of the frame asks for it, each time if the other side has one
/// much like it that finds no counterpart either. Scenes without the nodes that a method looks for
/// are fine, and so are flags for methods to come. To be called once the frame is planned.
void reportUnmatchedFlags(SceneManager& scene);

} // namespace terrane
