// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// <sequence>, <foreach> and <callMethod> (ork reference 2.10 to 2.12).
void declareControlTasks(Registry& registry);

} // namespace terrane
