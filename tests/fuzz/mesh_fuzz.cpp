// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a mesh file.
#include "render/mesh_file.h"

#include <cstdint>
#include <cstdlib>

using namespace terrane;

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto source = std::make_shared<SourceFile>(
        "a.mesh", std::string(reinterpret_cast<const char*>(data), size));
    Diagnostics diagnostics;
    const auto mesh = parseMesh(source, diagnostics);
    if (mesh.has_value() == (diagnostics.errors() > 0)) std::abort();
    for (const Diagnostic& diagnostic : diagnostics.all())
        toString(diagnostic);
    return 0;
}
