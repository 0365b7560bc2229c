// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace terrane {

class RenderTarget;
class TerrainNode;

/// The point at the centre of a picture's pixel, found by its depth; places are pixels from the top
/// left corner. None outside of the picture and where nothing is drawn. Waits for the GPU; GL
/// thread only.
/// @param worldFromScreen from OpenGL's clip space, as of when the picture was drawn
std::optional<glm::dvec3> pointAt(const RenderTarget& picture, const glm::dmat4& worldFromScreen,
                                  double x, double y);

/// Whether a point of the world can be ground: within twice a flat terrain's size, or nearly on a
/// planet or cylinder. What else has a depth (sky, sun, clouds) can't be dragged (terrain reference
/// 6). Anything can where there is no terrain. As of the last frame.
bool isNearTerrain(const glm::dvec3& point, const std::vector<TerrainNode*>& terrains);

} // namespace terrane
