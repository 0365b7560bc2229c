// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// Declares the element `module` with its initial uniform values (ork reference 2.3 to 2.5), which
/// builds a Module. Builders need the service GlContext.
void declareModule(Registry& registry);

} // namespace terrane
