// SPDX-License-Identifier: BSD-3-Clause
#include "render/glsl_legacy.h"

#include "render/glsl_log.h"

#include <doctest/doctest.h>

#include <random>

namespace terrane {

namespace {

GlslText textOf(const std::string& source, const std::string& path = "old.glsl") {
    const auto file = std::make_shared<const SourceFile>(path, source);
    GlslText text;
    text.append(file, 0, source.size());
    return text;
}

std::string rewrite(const std::string& source, int version = 330,
                    ShaderStage stage = ShaderStage::fragment,
                    const std::vector<std::string>& macros = {}) {
    std::vector<LegacyChange> changes;
    return rewriteLegacyGlsl(textOf(source), version, stage, macros, changes).text();
}

} // namespace

TEST_CASE("Old spellings are rewritten where core GLSL refuses them") {
    struct Row {
        const char* name;
        int version;
        const char* old;
        const char* core;
    };
    const Row rows[] = {
        {"array lookup", 330, "texture2DArray(s, p)", "texture(s, p)"},
        {"array gradient", 330, "texture2DArrayGrad(s,p,x,y)", "textureGrad(s,p,x,y)"},
        {"array level", 330, "texture1DArrayLod(s,p,0.)", "textureLod(s,p,0.)"},
        {"vendor suffix", 330, "texture2DGradARB(s,p,x,y)", "textureGrad(s,p,x,y)"},
        {"vendor suffix", 330, "textureCubeLodEXT(s,p,0)", "textureLod(s,p,0)"},
        {"offset", 330, "texture2DProjLodOffset(s,p,0,o)", "textureProjLodOffset(s,p,0,o)"},
        {"fetch", 330, "texelFetch2DArray(s,p,0)", "texelFetch(s,p,0)"},
        {"fetch with offset", 330, "texelFetch2DOffset(s,p,0,o)", "texelFetchOffset(s,p,0,o)"},
        {"fetch from a buffer", 330, "texelFetchBuffer(s,p)", "texelFetch(s,p)"},
        {"size", 330, "textureSize2DArray(s,0)", "textureSize(s,0)"},
        {"deprecated, but there in 3.30", 330, "texture2D(s,p)", "texture2D(s,p)"},
        {"deprecated, but there in 4.10", 410, "textureCubeLod(s,p,0)", "textureCubeLod(s,p,0)"},
        {"gone in 4.20", 420, "texture2D(s,p)", "texture(s,p)"},
        {"gone in 4.20", 450, "texture3DProj(s,p)", "textureProj(s,p)"},
        {"shadow lookups gave four components", 420, "shadow2D(s,f(p)).r + 1",
         "vec4(texture(s,f(p))).r + 1"},
        {"shadow lookups in 3.30", 330, "shadow2D(s,p)", "shadow2D(s,p)"},
        {"core names", 450, "texture(s,p)+textureLod(s,p,0)+textureProjGrad(s,p,x,y)",
         "texture(s,p)+textureLod(s,p,0)+textureProjGrad(s,p,x,y)"},
        {"names that only look alike", 450, "texture2DTile(p)+texture2Ds(p)+textureTile(p)",
         "texture2DTile(p)+texture2Ds(p)+textureTile(p)"},
        {"not a call", 450, "float texture2D = 1.0;", "float texture2D = 1.0;"},
        {"a member", 450, "a.texture2D(1)", "a.texture2D(1)"},
        {"in comments", 450, "// texture2D(s,p)\n/* filter */", "// texture2D(s,p)\n/* filter */"},
        {"in macros", 420, "#define T(p) texture2D(s, p)\n", "#define T(p) texture(s, p)\n"},
        {"geometry positions", 330, "gl_PositionIn[i].xyz", "gl_in[i].gl_Position.xyz"},
        {"geometry positions, nested", 330, "gl_PositionIn[a[1]+1]", "gl_in[a[1]+1].gl_Position"},
        {"geometry point sizes", 330, "gl_PointSizeIn[0]", "gl_in[0].gl_PointSize"},
        {"geometry vertices", 330, "i < gl_VerticesIn", "i < gl_in.length()"},
        {"instances", 330, "gl_InstanceIDARB", "gl_InstanceID"},
        {"reserved words", 330, "float filter = 1.0; a.input[2] = filter;",
         "float terrane_filter = 1.0; a.terrane_input[2] = terrane_filter;"},
        {"samples in 3.30", 330, "vec4 sample = f(buffer);", "vec4 sample = f(buffer);"},
        {"samples in 4.00", 400, "vec4 sample = f(sample) + sample.x;",
         "vec4 terrane_sample = f(terrane_sample) + terrane_sample.x;"},
        {"samples as qualifiers", 400, "sample in vec4 x; patch out vec3 y;",
         "sample in vec4 x; patch out vec3 y;"},
        {"buffers in 4.30", 430, "int buffer = 1; shared.x = buffer;",
         "int terrane_buffer = 1; terrane_shared.x = terrane_buffer;"},
        {"buffers as qualifiers", 430,
         "layout(std430) buffer; layout(std430) buffer B { int a; }; shared uint s;",
         "layout(std430) buffer; layout(std430) buffer B { int a; }; shared uint s;"},
        {"layouts", 430, "layout(shared) uniform A {int a;}; layout(packed) uniform B {int b;};",
         "layout(shared) uniform A {int a;}; layout(packed) uniform B {int b;};"},
        {"conditions name macros", 330, "#if filter\n#endif", "#if filter\n#endif"},
        {"varyings in 3.30", 330, "varying vec4 a;", "varying vec4 a;"},
        {"varyings in 4.20", 420, "varying vec4 a;", "in vec4 a;"},
        {"output in 3.30", 330, "gl_FragColor = c;", "gl_FragColor = c;"},
        {"output in 4.20", 420, "void main() { gl_FragColor = c; gl_FragColor.a = 1; }",
         "layout(location = 0) out vec4 terrane_FragColor;\n"
         "void main() { terrane_FragColor = c; terrane_FragColor.a = 1; }"},
        {"outputs in 4.20", 450, "in vec4 c; void main() { gl_FragData[1] = c; }",
         "layout(location = 0) out vec4 terrane_FragData[gl_MaxDrawBuffers];\n"
         "in vec4 c; void main() { terrane_FragData[1] = c; }"},
        {"output, with an old word first", 420, "varying vec4 c; void main() { gl_FragColor = c; }",
         "layout(location = 0) out vec4 terrane_FragColor;\n"
         "in vec4 c; void main() { terrane_FragColor = c; }"},
        {"output behind extensions", 420, "#extension GL_A : enable\nvoid main() { gl_FragColor; }",
         "#extension GL_A : enable\nlayout(location = 0) out vec4 terrane_FragColor;\n"
         "void main() { terrane_FragColor; }"},
        {"output behind conditional extensions", 420,
         "#ifdef A\n#if B\n#extension A : enable\n#endif\n#else\n#extension B : enable\n#endif\n"
         "void main() { gl_FragColor; }",
         "#ifdef A\n#if B\n#extension A : enable\n#endif\n#else\n#extension B : enable\n#endif\n"
         "layout(location = 0) out vec4 terrane_FragColor;\nvoid main() { terrane_FragColor; }"},
        {"output in the condition of an extension", 420,
         "#ifdef _FRAGMENT_\n#extension A : enable\nvoid main() { gl_FragColor; }\n#endif",
         "#ifdef _FRAGMENT_\n#extension A : enable\n"
         "layout(location = 0) out vec4 terrane_FragColor;\n"
         "void main() { terrane_FragColor; }\n#endif"},
        {"output of a macro", 420, "#define OUT gl_FragColor\nx",
         "layout(location = 0) out vec4 terrane_FragColor;\n#define OUT terrane_FragColor\nx"},
        {"extensions that became core", 330, "#extension GL_EXT_gpu_shader4 : require\nx", "\nx"},
        {"other extensions", 330, "#extension GL_ARB_gpu_shader5 : enable\nx",
         "#extension GL_ARB_gpu_shader5 : enable\nx"},
        {"line directives", 330, "a\n  # line 7 3 \nb", "a\n   \nb"},
        {"directives over several lines", 330,
         "#extension GL_EXT_gpu_shader4 /* a\nb */ : enable\n#line \\\n7\nc", "\n\n\n\nc"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK(rewrite(row.old, row.version) == row.core);
    }
    CHECK(rewrite("attribute vec4 p; varying vec2 q;", 430, ShaderStage::vertex) ==
          "in vec4 p; out vec2 q;");
    CHECK(rewrite("gl_FragColor", 430, ShaderStage::vertex) == "gl_FragColor");
}

TEST_CASE("What an author defines keeps its name") {
    const char* const ownFunction =
        "vec4 texture2DArray(sampler2D s, vec3 p) { return texture(s, p.xy); }\n"
        "void main() { c = texture2DArray(s, p); }";
    CHECK(rewrite(ownFunction) == ownFunction);
    const char* const ownMacro = "#define half float\nhalf x; half f(half y);";
    CHECK(rewrite(ownMacro) == ownMacro);
    CHECK(rewrite("filter(x)", 330, ShaderStage::fragment, {"filter(a) a"}) == "filter(x)");
    CHECK(rewrite("return texture2DArray(s, p);") == "return texture(s, p);");
}

TEST_CASE("Rewritten text still knows its places") {
    std::vector<LegacyChange> changes;
    const GlslText text = rewriteLegacyGlsl(textOf("= texture2DArray(x) b\nc"), 330,
                                            ShaderStage::fragment, {}, changes);
    CHECK(text.text() == "= texture(x) b\nc");
    CHECK(text.place(text.text().find("texture")).toString() == "old.glsl:1:3");
    CHECK(text.place(text.text().find("(x)")).toString() == "old.glsl:1:17");
    CHECK(text.place(text.text().find("c")).toString() == "old.glsl:2:1");
}

TEST_CASE("One warning a file tells what was rewritten, at the first place") {
    Diagnostics diagnostics;
    std::vector<LegacyChange> changes;
    GlslText text = textOf("\n  int filter;\n");
    text.append(textOf("texture2DArray(s,p)+texture2DArray(s,q)+input;", "other.glsl"));
    for (const ShaderStage stage : {ShaderStage::vertex, ShaderStage::fragment})
        rewriteLegacyGlsl(text, 330, stage, {}, changes);
    reportLegacyGlsl(changes, diagnostics);
    REQUIRE(diagnostics.all().size() == 2);
    std::string told;
    for (const Diagnostic& d : diagnostics.all()) {
        CHECK(d.code == "legacy-glsl");
        CHECK(d.severity == Severity::warning);
        told += d.place.toString() + " " + d.message + "\n";
    }
    CHECK(told.find("old.glsl:2:7 old GLSL rewritten: 'filter' to 'terrane_filter'\n") !=
          std::string::npos);
    CHECK(told.find("other.glsl:1:1 old GLSL rewritten: 'input' to 'terrane_input', "
                    "'texture2DArray' to 'texture'\n") != std::string::npos);
}

TEST_CASE("Renamed words get their names back") {
    CHECK(originalGlslName("terrane_filter") == "filter");
    CHECK(originalGlslName("a.terrane_input[2].terrane_sample") == "a.input[2].sample");
    CHECK(originalGlslName("terrane_position") == "terrane_position");
    CHECK(originalGlslName("myterrane_filter") == "myterrane_filter");
    CHECK(originalGlslName("terrane_filters") == "terrane_filters");
    CHECK(originalGlslName("`terrane_filter' undeclared") == "`filter' undeclared");
    CHECK(originalGlslName("terrane_FragColor") == "gl_FragColor");
    CHECK(originalGlslName("`terrane_FragData' unused") == "`gl_FragData' unused");
    CHECK(originalGlslName("terrane_FragColors") == "terrane_FragColors");
    CHECK(originalGlslName("") == "");
}

TEST_CASE("Any bytes can be rewritten, and need it once") {
    for (const std::string hostile : {"",
                                      "#",
                                      "#extension",
                                      "#line",
                                      "gl_PositionIn[",
                                      "gl_PositionIn",
                                      "shadow2D(",
                                      "filter",
                                      "/*",
                                      "texture2D(",
                                      "#define",
                                      "#define filter",
                                      "\xff\xfe filter \x01",
                                      "1.0.0.0e++",
                                      "gl_PositionIn[[[[]",
                                      "layout(((((packed",
                                      "gl_FragColor",
                                      "#extension x\ngl_FragData",
                                      "#endif\n#endif\n#extension\ngl_FragData[",
                                      "gl_FragColor\n#extension"}) {
        CAPTURE(hostile);
        const std::string once = rewrite(hostile, 430);
        CHECK(rewrite(once, 430) == once); // nothing old is left
    }
}

TEST_CASE("Random GLSL is rewritten and taken apart without harm") {
    const char* const words[] = {"#",      "extension", "GL_EXT_gpu_shader4",
                                 "line",   "define",    "filter",
                                 "sample", "layout",    "gl_PositionIn",
                                 "(",      ")",         "[",
                                 "]",      "shadow2D",  "texture2DArray",
                                 "/*",     "*/",        "//",
                                 "\\\n",   "\n",        " ",
                                 ";",      "{",         "varying",
                                 "1.5",    "include",   "\"x\"",
                                 ".",      "buffer",    "\r\n",
                                 "if",     "endif",     "gl_FragColor"};
    std::minstd_rand random(7);
    for (int round = 0; round < 3000; ++round) {
        std::string source;
        for (unsigned i = 0; i < random() % 30; ++i)
            source += words[random() % std::size(words)];
        CAPTURE(source);
        std::vector<LegacyChange> changes;
        const GlslText text =
            rewriteLegacyGlsl(textOf(source), 430, ShaderStage::fragment, {}, changes);
        const auto offset = offsetOf({.line = int(random() % 5),
                                      .column = int(random() % 20),
                                      .text = "`filter' undeclared"},
                                     text);
        if (offset && !text.text().empty()) CHECK(text.place(*offset).offset <= source.size());
        if (changes.empty()) CHECK(text.text() == source);
    }
}

} // namespace terrane
