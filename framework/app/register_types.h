// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// Declares every element type of the framework itself. The standard plugins come on top:
///
///     Registry registry;
///     registerStandardTypes(registry);
///     registerStandardPlugins(registry);   // plugins/standard_plugins.h
void registerStandardTypes(Registry& registry);

} // namespace terrane
