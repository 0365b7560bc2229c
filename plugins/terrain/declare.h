// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// Declares the producers and layers of the terrain plugin (terrain reference 1.7, 1.8). Builders
/// need the service GlContext.
void declareTerrainPlugin(Registry& registry);

void declareResidualProducer(Registry& registry);
void declareElevationProducer(Registry& registry);
void declareCpuElevationProducer(Registry& registry);
void declareNormalProducer(Registry& registry);

} // namespace terrane
