// SPDX-License-Identifier: BSD-3-Clause
#include "program_fixture.h"

namespace terrane {

TEST_CASE_FIXTURE(ProgramFixture, "A module of one file has the stages that it mentions") {
    const auto module = compile(source("m", R"(
#ifdef _VERTEX_
layout(location = 0) in vec4 p;
void main() { gl_Position = p; }
#endif
#ifdef _FRAGMENT_
layout(location = 0) out vec4 c;
void main() { c = vec4(1); }
#endif
)"));
    REQUIRE(module);
    CHECK(module->hasStage(ShaderStage::vertex));
    CHECK(module->hasStage(ShaderStage::fragment));
    CHECK_FALSE(module->hasStage(ShaderStage::geometry));
    CHECK(module->shaders().size() == 2);
}

TEST_CASE_FIXTURE(ProgramFixture, "A module of several files defines no stage macro") {
    ModuleSource both = source("both", "");
    both.file = nullptr;
    const auto shared = file("shared.glsl", "#ifdef _VERTEX_\n#error defined\n#endif\n"
                                            "#ifdef _FRAGMENT_\n#error defined\n#endif\n"
                                            "float one() { return 1.0; }\n");
    both.stageFiles[std::size_t(ShaderStage::vertex)] = shared;
    both.stageFiles[std::size_t(ShaderStage::fragment)] = shared;
    const auto module = compile(both);
    REQUIRE(module);
    CHECK(module->shaders().size() == 2);
    CHECK(module->files().size() == 1);
}

TEST_CASE_FIXTURE(ProgramFixture, "Libraries and files without any stage are modules") {
    CHECK(compile(source("library", "// _FRAGMENT_\nfloat f(float x) { return x; }\n")));
    const auto none = compile(source("none", "float f;\n"));
    REQUIRE(none);
    CHECK(none->shaders().empty());
}

TEST_CASE_FIXTURE(ProgramFixture, "Options become macros") {
    ModuleSource module = fragment("layout(location = 0) out vec4 c;\n"
                                   "void main() { c = vec4(TAPS, defined_a, 0, 0); }\n"
                                   "#ifndef A\n#error no A\n#endif\n");
    module.options = {"A", "TAPS 4", "defined_a 2.0", ""};
    const auto program = link(module);
    REQUIRE(program);
    CHECK(draw(*program) == glm::vec4(4, 2, 0, 0));
}

TEST_CASE_FIXTURE(ProgramFixture, "Errors are told at the author's line and column") {
    file("noise.glsl", "float noise() {\n    return  nothing1;\n}\n");
    file("all.glsl", "// everything\n\n/* a\n   comment */ #include \"noise.glsl\"\n"
                     "float f() { /* here */ return nothing2; }\n");
    CHECK_FALSE(compile(source("m", R"(#include "all.glsl"
#ifdef _FRAGMENT_
out vec4 c;
void main() {
	c  =   vec4( nothing3 );
}
#endif
)")));
    std::vector<std::string> chain;
    for (const Diagnostic& d : diagnostics.all()) {
        if (d.message.find("nothing1") != std::string::npos) chain = d.chain;
    }
    const std::string all = told();
    CHECK(all.find("noise.glsl:2:13 glsl-compile") != std::string::npos);
    CHECK(all.find("all.glsl:5:31 glsl-compile") != std::string::npos);
    CHECK(all.find("m.glsl:5:15 glsl-compile") != std::string::npos);
    REQUIRE(chain.size() == 2);
    CHECK(chain[0] == "#include at all.glsl:4:15");
    CHECK(chain[1] == "#include at m.glsl:1:1");
}

TEST_CASE_FIXTURE(ProgramFixture, "An error in text that two stages share is told once") {
    CHECK_FALSE(compile(source("m", "// _VERTEX_ _FRAGMENT_\nfloat f() { return nothing; }\n")));
    const std::string all = told();
    CHECK(all == "m.glsl:2:20 glsl-compile\nm.glsl:2:13 glsl-compile\n");
}

TEST_CASE_FIXTURE(ProgramFixture, "What no file says is told at the module") {
    SUBCASE("a version that there is not") {
        CHECK_FALSE(link(fragment("void main() {}\n", 7)));
        CHECK(told().find("archive.xml:2:3 glsl-compile") != std::string::npos);
    }
    SUBCASE("a bad option") {
        ModuleSource bad = fragment("void main() {}\n");
        bad.options = {"4"};
        CHECK_FALSE(compile(bad));
        CHECK(told().find("archive.xml:2:3 glsl-compile") != std::string::npos);
    }
}

TEST_CASE_FIXTURE(ProgramFixture, "A missing include is the only thing that is told") {
    CHECK_FALSE(compile(source("m", "// _VERTEX_\n  #include \"none.glsl\"\nfloat x = none;\n")));
    CHECK(told() == "m.glsl:2:3 include-missing\n");
}

TEST_CASE_FIXTURE(ProgramFixture, "Hostile sources are refused, or compile") {
    for (const std::string& text :
         {std::string("/* _FRAGMENT_ "), std::string("_FRAGMENT_ \0 x", 14),
          std::string("_FRAGMENT_ \xff\xfe"), std::string("#include \"m.glsl\" _FRAGMENT_"),
          "_FRAGMENT_" + std::string(100000, '('), std::string("#version 450\n_FRAGMENT_"),
          std::string("#if _FRAGMENT_\n"), std::string("#line 99999999\n_FRAGMENT_ x y z\n")}) {
        CAPTURE(text.substr(0, 40));
        CHECK_FALSE(compile(source("m", text)));
        bool error = false;
        for (const Diagnostic& d : diagnostics.all()) {
            error = error || d.severity == Severity::error;
            CHECK(d.place);
        }
        CHECK(error);
        diagnostics.clear();
    }
}

TEST_CASE_FIXTURE(ProgramFixture, "Old GLSL compiles, and its uniforms keep their names") {
    const auto program = shows("uniform float filter; uniform sampler2DArray input;",
                               "vec4(filter) + texture2DArray(input, vec3(0))");
    REQUIRE(program);
    CHECK(told() == "fragment.glsl:1:15 legacy-glsl\n");
    program->find("filter").set(2.0F);
    const Texture black(*context, {.target = TextureTarget::texture2DArray});
    const_cast<Texture&>(black).clear();
    program->find("input").set(black);
    CHECK(draw(*program) == glm::vec4(2, 2, 2, 2));
}

TEST_CASE_FIXTURE(ProgramFixture,
                  "The outputs that fragment shaders once had draw in any version") {
    struct Row {
        int version;
        const char* fragment;
        bool rewritten;
    };
    const Row rows[] = {
        {330, "void main() { gl_FragColor = vec4(1, 2, 3, 4); }", false},
        {420,
         "#extension GL_ARB_gpu_shader5 : enable\nvoid main() { gl_FragColor = vec4(1, 2, 3, 4); }",
         true},
        {450,
         "#define OUT gl_FragColor\nvoid f() { OUT = vec4(4); }\n"
         "void main() { f(); gl_FragColor.rgb = vec3(1, 2, 3); }",
         true},
        {450, "void main() { gl_FragData[0] = vec4(1, 2, 3, 4); }", true},
    };
    for (const Row& row : rows) {
        CAPTURE(row.version);
        CAPTURE(row.fragment);
        ModuleSource m = source(
            "m",
            "#ifdef _VERTEX_\nlayout(location = 0) in vec4 p;\nvoid main() { gl_Position = p; }\n"
            "#endif\n#ifdef _FRAGMENT_\n" +
                std::string(row.fragment) + "\n#endif\n");
        m.version = row.version;
        const auto program = link(m);
        REQUIRE(program);
        CHECK(draw(*program) == glm::vec4(1, 2, 3, 4));
        CHECK((told().find("legacy-glsl") != std::string::npos) == row.rewritten);
        diagnostics.clear();
    }
}

TEST_CASE_FIXTURE(ProgramFixture, "Old geometry shaders compile") {
    const auto program = link(source("m", R"(
#ifdef _VERTEX_
layout(location = 0) in vec4 p;
void main() { gl_Position = p; }
#endif
#ifdef _GEOMETRY_
#extension GL_EXT_geometry_shader4 : require
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
void main() {
    for (int i = 0; i < gl_VerticesIn; ++i) {
        gl_Position = gl_PositionIn[i];
        EmitVertex();
    }
    EndPrimitive();
}
#endif
#ifdef _FRAGMENT_
layout(location = 0) out vec4 c;
void main() { c = vec4(1, 2, 3, 4); }
#endif
)"));
    REQUIRE(program);
    CHECK(draw(*program) == glm::vec4(1, 2, 3, 4));
    CHECK(told() == "m.glsl:7:1 legacy-glsl\n");
}

} // namespace terrane
