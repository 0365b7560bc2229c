// SPDX-License-Identifier: BSD-3-Clause
#include "render/module_resource.h"

#include "core/image.h"
#include "gl_archive.h"
#include "render/framebuffer.h"
#include "render/mesh.h"
#include "render/program.h"
#include "render/program_resource.h"
#include "render/texture_resource.h"
#include "render/transform_feedback.h"

#include <cstring>

namespace terrane {

namespace {

struct ModuleFixture : GlArchive {
    std::optional<ProgramBindings> bindings{std::in_place, *context};

    ModuleFixture() {
        declareModule(registry);
        declareProgram(registry);
        declareTextures(registry);
    }
    ~ModuleFixture() {
        manager.reset();
        bindings.reset();
    }

    void shader(const std::string& name, const std::string& text) {
        writeFile(folder / name, text);
    }
    /// A fragment shader that shows a vec4.
    void shows(const std::string& declarations, const std::string& colour) {
        shader("m.glsl", "#ifdef _FRAGMENT_\n" + declarations +
                             "\nlayout(location = 0) out vec4 c;\nvoid main() { c = " + colour +
                             "; }\n#endif\n");
    }
    /// "file:line:col code" of each diagnostic; they are taken out.
    std::string told() {
        std::string text;
        for (const Diagnostic& d : diagnostics.all()) {
            const std::string place = d.place.toString();
            const std::size_t inside = place.find(folder.filename().string());
            text += (inside == std::string::npos
                         ? place
                         : place.substr(inside + folder.filename().string().size() + 1)) +
                    " " + d.code + "\n";
        }
        diagnostics.clear();
        return text;
    }
    template <class T>
    T* find(const std::string& entries, const std::string& name) {
        read(entries);
        manager->services().provide(*bindings);
        return get<T>(name);
    }
    /// The program of module m with these attributes and children.
    Program* program(const std::string& attributes, const std::string& children = "") {
        return find<Program>(
            "<module name='m' version='400' " + attributes + ">" + children + "</module>", "m;");
    }
    glm::vec4 draw(Program& program) {
        const auto texture = std::make_shared<Texture>(
            *context, TextureDescription{.format = InternalFormat::rgba32f});
        Framebuffer target(*context);
        target.attach(AttachmentPoint::colour0, {texture});
        target.setDrawBuffers({AttachmentPoint::colour0});
        target.setReadBuffer(AttachmentPoint::colour0);
        target.state.viewport = {0, 0, 1, 1};
        target.use();
        const Mesh quad(*context, makeQuadMesh());
        program.use();
        quad.draw();
        const auto bytes = target.readPixels(0, 0, 1, 1, {TransferFormat::rgba, TransferType::f32});
        glm::vec4 pixel;
        std::memcpy(&pixel, bytes.data(), sizeof pixel);
        return pixel;
    }
};

} // namespace

TEST_CASE_FIXTURE(ModuleFixture, "A program is linked from the modules in its name") {
    shows("", "colour()");
    shader("c.glsl", "#include \"d.glsl\"\nvec4 colour() { return D; } // _FRAGMENT_");
    shader("d.glsl", "#define D vec4(A, B, 3, 4)");
    shader("m.glsl", "#ifdef _FRAGMENT_\nvec4 colour();\nlayout(location = 0) out vec4 c;\n"
                     "void main() { c = colour(); }\n#endif\n");
    Program* p = find<Program>("<module name='m' version='330' source='m.glsl'/>"
                               "<module name='c' version='330' source='c.glsl' options='A 1,B 2'/>",
                               "m;c;");
    CHECK(told() == "");
    REQUIRE(p);
    CHECK(p->name() == "m;c;");
    CHECK(draw(*p) == glm::vec4(1, 2, 3, 4));
    CHECK(get<Module>("c")->files().size() == 2);
    const auto& read = manager->entries().at("c")->files;
    CHECK(std::count_if(read.begin(), read.end(),
                        [&](const UsedFile& file) { return file.path == folder / "d.glsl"; }) == 1);
    CHECK(get<Module>("c")->programs().size() == 1);
}

TEST_CASE_FIXTURE(ModuleFixture, "A program may be written") {
    shows("", "vec4(1)");
    CHECK(find<Program>("<program name='p'><module name='m'/></program>"
                        "<module name='m' version='330' source='m.glsl'/>",
                        "p"));
    CHECK(told() == "");
}

TEST_CASE_FIXTURE(ModuleFixture, "A module may have a file for each stage") {
    shader("f.glsl", "layout(location = 0) out vec4 c;\nvoid main() { c = vec4(1, 2, 3, 4); }");
    shader("v.glsl", "layout(location = 0) in vec4 p;\nvoid main() { gl_Position = p; }");
    Program* p = program("vertex='v.glsl' fragment='f.glsl'");
    CHECK(told() == "");
    REQUIRE(p);
    CHECK(draw(*p) == glm::vec4(1, 2, 3, 4));
}

TEST_CASE_FIXTURE(ModuleFixture, "Initial values of all kinds") {
    struct Row {
        const char* element;
        const char* type;
        const char* shown;
        glm::vec4 expected;
    };
    const Row rows[] = {
        {"<uniform1f name='u' x='1.5'/>", "float", "vec4(u)", glm::vec4(1.5)},
        {"<uniform2f name='u' x='1' y='2'/>", "vec2", "vec4(u, 0, 0)", {1, 2, 0, 0}},
        {"<uniform3f name='u' y='2'/>", "vec3", "vec4(u, 9)", {0, 2, 0, 9}},
        {"<uniform4f name='u' x='1' y='2' z='3' w='4'/>", "vec4", "u", {1, 2, 3, 4}},
        {"<uniform2d name='u' x='1' y='2'/>", "dvec2", "vec4(u, 0, 0)", {1, 2, 0, 0}},
        {"<uniform3i name='u' x='1.9' y='-2' z='3'/>", "ivec3", "vec4(u, 0)", {1, -2, 3, 0}},
        {"<uniform1vi name='u' x='7'/>", "uint", "vec4(u)", glm::vec4(7)},
        {"<uniform2ui name='u' x='7' y='8'/>", "uvec2", "vec4(u, 0, 0)", {7, 8, 0, 0}},
        {"<uniform3b name='u' x='0' y='1' z='-2'/>", "bvec3", "vec4(u, 0)", {0, 1, 1, 0}},
        {"<uniformMatrix2f name='u' value='1,2,3,4'/>", "mat2", "vec4(u[0], u[1])", {1, 3, 2, 4}},
        {"<uniformMatrix2d name='u' value='1, 2, 3, 4'/>",
         "dmat2",
         "vec4(u[0], u[1])",
         {1, 3, 2, 4}},
        {"<uniformMatrix3 name='u' value='identity'/>", "mat3", "vec4(u[1], u[2].z)", {0, 1, 0, 1}},
        {"<uniformMatrix2x3f name='u' value='1,2,3,4,5,6'/>",
         "mat2x3",
         "vec4(u[0], u[1].x)",
         {1, 3, 5, 2}},
        {"<uniformMatrix4x2f name='u' value='zero'/>", "mat4x2", "vec4(u[0], u[3])", glm::vec4(0)},
        {"<uniformSampler name='u' texture='red.png'/>",
         "sampler2D",
         "texture(u, vec2(0.5))",
         {1, 0, 0, 1}},
    };
    Image red = makeImage(1, 1, 4);
    const std::byte pixel[4] = {std::byte{255}, {}, {}, std::byte{255}};
    std::memcpy(red.row(0), pixel, 4);
    writePng(folder / "red.png", red);
    for (const Row& row : rows) {
        CAPTURE(row.element);
        shows("uniform " + std::string(row.type) + " u;", row.shown);
        Program* p = program("source='m.glsl'", row.element);
        CHECK(told() == "");
        REQUIRE(p);
        CHECK(draw(*p) == row.expected);
    }
}

TEST_CASE_FIXTURE(ModuleFixture, "What is wrong with a module is told where it stands") {
    struct Row {
        const char* element;
        const char* told; // part of it
    };
    // The element starts at column 1 of line 2.
    const Row rows[] = {
        {"<module name='m' source='m.glsl'/>", ":2:1 missing-attribute"},
        {"<module name='m' version='330'/>", ":2:1 missing-attribute"},
        {"<module name='m' version='330' source='none.glsl'/>", ":2:40 file-missing"},
        {"<module name='m' version='330' fragment='none.glsl'/>", ":2:42 file-missing"},
        {"<module name='m' version='330' sources='m.glsl'/>", ":2:32 unknown-attribute"},
        {"<module name='m' version='330' source='m.glsl' feedback='interleaved'/>",
         ":2:1 missing-attribute"},
        {"<module name='m' version='330' source='m.glsl' varyings='a'/>", ":2:58 unused-attribute"},
        {"<module name='m' version='330' source='m.glsl' vertex='m.glsl'/>",
         ":2:56 unused-attribute"},
        {"<module name='m' version='330' source='m.glsl'><uniform5f name='u'/></module>",
         ":2:48 unknown-element"},
        {"<module name='m' version='330' source='m.glsl'><uniform1 name='u'/></module>",
         ":2:48 unknown-element"},
        {"<module name='m' version='330' source='m.glsl'><uniform1f x='1'/></module>",
         ":2:48 missing-attribute"},
        {"<module name='m' version='330' source='m.glsl'><uniform1f name='u' y='1'/></module>",
         ":2:68 unknown-attribute"},
        {"<module name='m' version='330' source='m.glsl'><uniformMatrix5f name='u' "
         "value='zero'/></module>",
         ":2:48 unknown-element"},
        {"<module name='m' version='330' source='m.glsl'><uniformMatrix2f name='u' "
         "value='1,2,3'/></module>",
         ":2:81 bad-value"},
        {"<module name='m' version='330' source='m.glsl'><uniformMatrix2f name='u' "
         "value='1,2,x,4'/></module>",
         ":2:85 bad-value"},
        {"<module name='m' version='330' source='m.glsl'><uniformMatrix2f name='u' "
         "value='1,2,3,4,5'/></module>",
         ":2:89 extra-values"},
        {"<module name='m' version='330' source='m.glsl'><uniformMatrix2x3f name='u' "
         "value='identity'/></module>",
         ":2:83 bad-value"},
        {"<module name='m' version='330' source='m.glsl'><uniformSampler name='u' "
         "texture='none.png'/></module>",
         ":2:82 file-missing"},
        {"<module name='m' version='330' source='m.glsl'><uniformSubroutine name='u' "
         "subroutine='f' stage='PIXEL'/></module>",
         ":2:98 unknown-word"},
        {"<module name='m' version='330' source='m.glsl'><uniformSubroutine name='u' "
         "stage='VERTEX'/></module>",
         ":2:48 missing-attribute"},
        // Accepted, as the original did.
        {"<module name='m' version='330' source='m.glsl'><uniform3fv name='u'/></module>",
         ":2:48 unknown-element"},
        {"<module name='m' version='330' source='m.glsl'><uniformMatrix3x name='u' "
         "value='zero'/></module>",
         ":2:48 unknown-element"},
        {"<module name='m' version='330' source='m.glsl'><uniform1f name='u' x='nan'/></module>",
         ":2:71 out-of-range"},
        {"<module name='m' version='330' source='m.glsl'><texture2D/></module>",
         ":2:48 unknown-element"},
        {"<module name='m' version='7' source='m.glsl'/>", ":2:27 glsl-compile"},
        {"<module name='m' version='330' source='m.glsl' options='4'/>", ":2:57 glsl-compile"},
    };
    shows("", "vec4(1)");
    for (const Row& row : rows) {
        CAPTURE(row.element);
        find<Module>(row.element, "m");
        const std::string all = told();
        CAPTURE(all);
        CHECK(all.find(row.told) != std::string::npos);
    }
}

TEST_CASE_FIXTURE(ModuleFixture, "Errors in shaders are told in their files") {
    shader("m.glsl", "#include \"a/b.glsl\"\n// _FRAGMENT_\n#include \"c.glsl\"\n");
    std::filesystem::create_directory(folder / "a");
    shader("a/b.glsl", "float b() {\n    return bad;\n}\n");
    shader("c.glsl", "");
    CHECK_FALSE(find<Module>("<module name='m' version='330' source='m.glsl'/>", "m"));
    CHECK(told().find("a/b.glsl:2:12 glsl-compile") != std::string::npos);
    shader("m.glsl", "// _FRAGMENT_\n  #include \"d.glsl\"\n");
    CHECK_FALSE(find<Module>("<module name='m' version='330' source='m.glsl'/>", "m"));
    CHECK(told().find("m.glsl:2:3 include-missing") != std::string::npos);
}

TEST_CASE_FIXTURE(ModuleFixture, "A program needs modules, and these to compile") {
    shows("", "bad");
    CHECK_FALSE(program("source='m.glsl'"));
    const std::string all = told();
    CHECK(all.find("m.glsl:4:19 glsl-compile") != std::string::npos);
    CHECK(all.find("glsl-link") == std::string::npos);
    CHECK_FALSE(find<Program>("<program name='p'/>", "p"));
    CHECK(told() != "");
    CHECK_FALSE(find<Program>("", "none;"));
    CHECK(told() != "");
}

TEST_CASE_FIXTURE(ModuleFixture, "Modules choose subroutines") {
    shader("m.glsl", "#ifdef _FRAGMENT_\nsubroutine vec4 Colour();\n"
                     "subroutine(Colour) vec4 red() { return vec4(1, 0, 0, 1); }\n"
                     "subroutine(Colour) vec4 blue() { return vec4(0, 0, 1, 1); }\n"
                     "subroutine uniform Colour paint;\nlayout(location = 0) out vec4 c;\n"
                     "void main() { c = paint(); }\n#endif\n");
    Program* const p = program("source='m.glsl'", "<uniformSubroutine name='paint' "
                                                  "subroutine='blue' stage='FRAGMENT'/>");
    REQUIRE(p);
    CHECK(draw(*p) == glm::vec4(0, 0, 1, 1));
    CHECK(told() == "");
    REQUIRE(program("source='m.glsl'", "<uniformSubroutine name='paint' subroutine='green' "
                                       "stage='FRAGMENT'/>"));
    CHECK(told() == "archive.xml:2:92 unmatched-uniform\n");
}

TEST_CASE_FIXTURE(ModuleFixture, "Infinity is a value of uniforms") {
    shows("uniform vec2 u;", "vec4(u.x > 1e38 ? 1.0 : 0.0, u.y < -1e38 ? 1.0 : 0.0, 0, 1)");
    Program* const p = program("source='m.glsl'", "<uniform2f name='u' x='inf' y='-inf'/>");
    REQUIRE(p);
    CHECK(draw(*p) == glm::vec4(1, 1, 0, 1));
    CHECK(told() == "");
}

TEST_CASE_FIXTURE(ModuleFixture, "A program is taken from its binary, if it can be") {
    shows("uniform vec4 u;", "u");
    const std::string element = "<module name='m' version='330' source='m.glsl'>"
                                "<uniform4f name='u' x='1' y='2' z='3' w='4'/></module>";
    Program* p = find<Program>(element, "m;");
    REQUIRE(p);
    const auto binary = p->binary();
    const auto write = [&](std::uint32_t format, const std::string& bytes) {
        std::string file(sizeof format, '\0');
        std::memcpy(file.data(), &format, sizeof format);
        writeFile(folder / "m;.bin", file + bytes);
    };
    if (binary) {
        // The file counts, not the module's text.
        write(binary->format, binary->bytes);
        shows("uniform vec4 u;", "vec4(0)");
        p = find<Program>(element, "m;");
        REQUIRE(p);
        CHECK(draw(*p) == glm::vec4(1, 2, 3, 4));
        CHECK(told() == "");
    }
    shows("uniform vec4 u;", "u * 2.0");
    for (const char* bytes : {"", "x", "something that no driver takes"}) {
        CAPTURE(bytes);
        write(7, bytes);
        p = find<Program>(element, "m;");
        REQUIRE(p);
        CHECK(draw(*p) == glm::vec4(2, 4, 6, 8));
        CHECK(told().find("program-binary") != std::string::npos);
    }
}

TEST_CASE_FIXTURE(ModuleFixture, "A module says what is captured") {
    shader("m.glsl", "#ifdef _VERTEX_\nlayout(location = 0) in vec4 p; out vec2 twice;\n"
                     "void main() { gl_Position = p; twice = 2.0 * p.xy; }\n#endif\n");
    for (const char* mode : {"interleaved", "separate"}) {
        CAPTURE(mode);
        Program* const p =
            find<Program>("<module name='m' version='330' source='m.glsl' feedback='" +
                              std::string(mode) + "' varyings='twice'/>",
                          "m;");
        REQUIRE(p);
        const auto captured = std::make_shared<Buffer>(*context);
        captured->allocate(24);
        TransformFeedback feedback(*context);
        feedback.setBuffer(0, captured);
        const Mesh quad(*context, makeQuadMesh());
        p->use();
        feedback.begin(PrimitiveMode::triangles, false);
        quad.draw({.count = 3});
        feedback.end();
        std::array<float, 6> numbers{};
        captured->read(0, std::as_writable_bytes(std::span(numbers)));
        CHECK(numbers == std::array<float, 6>{-2, -2, 2, -2, -2, 2});
        CHECK(told() == "");
    }
    CHECK_FALSE(find<Program>("<module name='m' version='330' source='m.glsl' "
                              "feedback='interleaved' varyings='none'/>",
                              "m;"));
    CHECK(told().find("glsl-link") != std::string::npos);
}

} // namespace terrane
