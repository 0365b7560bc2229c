// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// Declares the elements of plugins that are not built yet, so that archives which use them load
/// with a warning. To be called before the plugins that are built.
void declarePlannedPlugins(Registry& registry);

} // namespace terrane
