// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// Declares the element types of the plugins that come with Terrane, after registerStandardTypes.
void registerStandardPlugins(Registry& registry);

} // namespace terrane
