// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// Declares the element `program`, which builds a Program; names such as `a;b;` stand for one with
/// these modules (ork reference 1.2, 2.6). Builders need the services GlContext and
/// ProgramBindings.
void declareProgram(Registry& registry);

} // namespace terrane
