// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "render/mesh_data.h"

#include <memory>
#include <optional>

namespace terrane {

/// Reads a `.mesh` text (Ork reference 2.7): bounds, topology, attributes, vertices, indices, as
/// words between white space; remarks may follow the last index. Nothing, with a diagnostic
/// ("mesh-syntax"), when anything is wrong: bad words and numbers, indices without a vertex, a text
/// that ends early. Memory is only taken for what the text can hold, whatever counts it claims. Any
/// thread.
std::optional<MeshData> parseMesh(std::shared_ptr<const SourceFile> file, Diagnostics& diagnostics);

} // namespace terrane
