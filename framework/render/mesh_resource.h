// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/mesh_data.h"

#include <optional>
#include <string_view>

namespace terrane {

class Registry;

/// Declares the element mesh, which builds a Mesh of a `.mesh` file (Ork reference 2.7), or, where
/// the search folders have no such file, of builtInMesh. Builders need the service GlContext.
void declareMesh(Registry& registry);

/// The meshes that every archive may name: `quad.mesh`, the full-screen strip; `grid.mesh`, a grid
/// of 24 x 24 quads as terrains are drawn with; `grid<n>.mesh` with n x n vertices, 2 to 1025; each
/// grid also as `...skirt.mesh`, which leaves no gaps (makeSkirtedGridMesh), and as
/// `...adjacency.mesh`, for geometry shaders. Nothing for other names.
std::optional<MeshData> builtInMesh(std::string_view name);

} // namespace terrane
