// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a mesh file.
#include "render/mesh_file.h"
#include "require.h"

#include <cstdint>

using namespace terrane;

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto source = std::make_shared<SourceFile>(
        "a.mesh", std::string(reinterpret_cast<const char*>(data), size));
    Diagnostics diagnostics;
    const auto mesh = parseMesh(source, diagnostics);
    test::require(mesh.has_value() == (diagnostics.errors() == 0), "either a mesh or an error");
    test::requireToldWell(diagnostics);
    if (!mesh) return 0;
    test::require(mesh->vertices.size() == mesh->vertexCount * mesh->stride(),
                  "there are as many vertices as it says");
    for (const std::uint32_t index : mesh->indices)
        test::require(index < mesh->vertexCount, "an index has a vertex");
    return 0;
}
