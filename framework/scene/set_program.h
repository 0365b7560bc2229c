// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/value.h"

namespace terrane {

class BindContext;
class Module;
class Registry;

/// The module of a name: `this.material` is a module of the node, a plain name a resource. The
/// reference is unresolved, with a diagnostic, when there is none.
Ref<Module> findModule(const Attr<Target>& name, BindContext& context);

/// <setProgram> (ork reference 2.13).
void declareSetProgram(Registry& registry);

} // namespace terrane
