// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// Declares the elements gpuTileStorage, cpuByteTileStorage, cpuFloatTileStorage, objectTileStorage
/// and tileCache, and names the interfaces of producers and layers. Builders need the service
/// GlContext.
void declareProducers(Registry& registry);

} // namespace terrane
