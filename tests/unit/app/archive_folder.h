// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/register_types.h"
#include "core/files.h"
#include "plugins/standard_plugins.h"
#include "resource/registry.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <unistd.h>

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

/// A temporary folder with files, removed at the end.
class ArchiveFolder {
public:
    ArchiveFolder() {
        static int number = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("terrane-app-" + std::to_string(getpid()) + "-" + std::to_string(++number));
        std::filesystem::create_directories(path_);
    }
    ~ArchiveFolder() {
        std::error_code error;
        std::filesystem::remove_all(path_, error);
    }
    ArchiveFolder(const ArchiveFolder&) = delete;
    ArchiveFolder& operator=(const ArchiveFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    void write(const std::string& name, const std::string& text) {
        std::filesystem::create_directories((path_ / name).parent_path());
        REQUIRE(writeFile(path_ / name, text));
    }

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

private:
    std::filesystem::path path_;
};

} // namespace terrane
