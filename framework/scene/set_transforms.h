// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// <setTransforms>: hands frames of the scene graph to a program (ork reference 2.15).
void declareSetTransforms(Registry& registry);

} // namespace terrane
