// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// Declares the element multithreadScheduler, and names the interface of schedulers. Its errors go
/// to the diagnostics of the resource manager, which must outlive the scheduler.
void declareScheduler(Registry& registry);

} // namespace terrane
