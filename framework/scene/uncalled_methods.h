// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class SceneManager;

/// Binds the methods of nodes that the frame does not call, to tell what is wrong in them and to
/// link their programs, and lets go of them. What they expect of their callers, the variables of
/// loops, can't be told. To be called once the frame is planned.
void checkUncalledMethods(SceneManager& scene);

} // namespace terrane
