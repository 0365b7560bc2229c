// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// Declares the elements of the framework that archives may use and that are not built yet, so that
/// such archives load with a warning. To be called first: whoever builds one declares it again.
void declarePlannedTypes(Registry& registry);

} // namespace terrane
