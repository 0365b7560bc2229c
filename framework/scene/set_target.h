// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// <setTarget>: draws into textures, or, without any, into the screen again (ork reference 2.14).
void declareSetTarget(Registry& registry);

} // namespace terrane
