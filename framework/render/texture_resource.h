// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;

/// Declares the elements texture1D, texture1DArray, texture2D, texture2DArray, texture3D,
/// textureCube, textureCubeArray and textureRectangle (Ork reference 2.2), which build a Texture. A
/// texture without a source starts out zeroed. Builders need the service GlContext.
void declareTextures(Registry& registry);

} // namespace terrane
