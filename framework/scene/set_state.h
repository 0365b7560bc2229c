// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// <setState>: changes what is written, of the state of the current framebuffer (ork reference
/// 2.16). State persists; nothing is restored.
void declareSetState(Registry& registry);

} // namespace terrane
