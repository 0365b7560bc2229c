// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/module.h"
#include "resource/declaration.h"

#include <optional>
#include <string>
#include <vector>

namespace terrane {

class Registry;

/// `uniform1f` to `uniform4ui`.
std::vector<std::string> vectorUniformTags();

/// Declares the children of `module` that give uniforms their initial values (ork reference 2.5),
/// in the order in which tags are to be matched.
std::vector<const ElementDeclaration*> declareInitialUniforms(Registry& registry);

/// The function that a valid <uniformSubroutine> chooses; nothing for any other child.
std::optional<InitialSubroutine> initialSubroutine(const Child& child);

/// The value that a valid child says, or nothing if it is not one of these, or has no effect.
std::optional<InitialUniform> initialUniform(const Child& child);

} // namespace terrane
