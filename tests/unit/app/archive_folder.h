// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/register_types.h"
#include "plugins/standard_plugins.h"
#include "resource/registry.h"
#include "temporary_folder.h"

#include <doctest/doctest.h>

#include <string>

namespace terrane {

/// All element types that `terrane` knows.
inline const Registry& standardRegistry() {
    static const Registry& registry = []() -> const Registry& {
        static Registry r;
        registerStandardTypes(r);
        registerStandardPlugins(r);
        return r;
    }();
    return registry;
}

/// A temporary folder with archives in it.
class ArchiveFolder : public test::TemporaryFolder {
public:
    void write(const std::string& name, const std::string& text) { file(name, text); }

    /// An archive that fills the picture with one colour: "r, g, b" from 0 to 1.
    void writeColour(const std::string& colour, const std::string& folder = ".") {
        write(folder + "/archive.xml", kScene);
        write(folder + "/fill.glsl", "#ifdef _VERTEX_\n"
                                     "layout(location = 0) in vec3 position;\n"
                                     "void main() { gl_Position = vec4(position, 1.0); }\n"
                                     "#endif\n"
                                     "#ifdef _FRAGMENT_\n"
                                     "layout(location = 0) out vec4 result;\n"
                                     "void main() { result = vec4(" +
                                         colour +
                                         ", 1.0); }\n"
                                         "#endif\n");
        write(folder + "/whole.mesh", "0 1 0 1 0 0 trianglestrip 1 0 3 float false\n"
                                      "4  -1 -1 0  1 -1 0  -1 1 0  1 1 0\n0\n");
    }

    static constexpr const char* kScene = R"(<archive>
    <module name="fill" version="330" source="fill.glsl"/>
    <sequence name="drawFrame">
        <setProgram><module name="fill"/></setProgram>
        <drawMesh name="whole"/>
    </sequence>
    <node name="scene">
        <node flags="camera"><method id="draw" value="drawFrame"/></node>
    </node>
</archive>
)";
};

} // namespace terrane
