// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_fixture.h"

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace terrane {

namespace {

struct DrawFixture : SceneFixture {
    DrawFixture() {
        write("flat.glsl", "uniform vec4 colour;\n#ifdef _FRAGMENT_\n"
                           "layout(location = 0) out vec4 result;\n"
                           "void main() { result = colour; }\n#endif\n");
        // Reads a texture at its smallest level.
        write("show.glsl",
              "uniform sampler2D image;\n#ifdef _FRAGMENT_\n"
              "layout(location = 0) out vec4 result;\n"
              "void main() { result = textureLod(image, vec2(0.5), 10.0); }\n#endif\n");
    }

    // Draws a full-screen quad in a colour.
    static std::string paint(const std::string& module) {
        return "<setProgram><module name=\"" + module +
               "\"/></setProgram><drawMesh name=\"quad\"/>\n";
    }
    static std::string module(const std::string& name, const std::string& colour) {
        return "<module name=\"" + name + "\" version=\"330\" source=\"flat.glsl\">" +
               "<uniform4f name=\"colour\" " + colour + "/></module>\n";
    }
    void loadFrame(const std::string& entries, const std::string& tasks,
                   const std::string& ofCamera = "") {
        load(module("red", R"(x="1" w="1")") + module("green", R"(y="1" w="1")") +
             module("half", R"(z="1" w="0.5")") + entries + "<sequence name=\"frame\">\n" + tasks +
             "</sequence><node name=\"scene\"><node flags=\"camera\"><translate x=\"1\" y=\"2\" "
             "z=\"3\"/><method id=\"draw\" value=\"frame\"/>" +
             ofCamera + "</node></node>");
    }
};

} // namespace

TEST_CASE_FIXTURE(DrawFixture, "setState changes what it says and leaves the rest") {
    struct Row {
        const char* name;
        const char* state;
        Colour after; // red below, green with that state on top
    };
    const Row rows[] = {
        {"depth test fails at equal depth", "<setState/>", {255, 0, 0}},
        {"depth test off", "<setState><depth enable='false'/></setState>", {0, 255, 0}},
        {"depth function",
         "<setState><depth enable='true' value='LEQUAL'/></setState>",
         {0, 255, 0}},
        {"depth without enable is off", "<setState><depth value='NEVER'/></setState>", {0, 255, 0}},
        {"write mask",
         "<setState><depth/><write r='true' g='false' b='true' a='true'/></setState>",
         {0, 0, 0}},
        {"scissor elsewhere",
         "<setState><depth/><scissor enable='true' x='0' y='0' width='2' height='2'/></setState>",
         {255, 0, 0}},
        {"viewport elsewhere",
         "<setState><depth/><viewport x='0' y='0' width='2' height='2'/></setState>",
         {255, 0, 0}},
        {"culled faces",
         "<setState><depth/><polygon front='CULL' back='FILL'/></setState>",
         {255, 0, 0}},
        {"additive blending",
         "<setState><depth/><blend enable='true' eq='ADD' src='ONE' dst='ONE'/></setState>",
         {255, 255, 0}},
        {"blend without attributes is off",
         "<setState><depth/><blend enable='true' eq='ADD' src='ONE' dst='ONE'/><blend/></setState>",
         {0, 255, 0}},
        {"clear comes last",
         "<setState clearColor='true'><depth/><clear r='0' g='0' b='1' a='1'/></setState>",
         {0, 255, 0}},
        {"logical operation",
         "<setState><depth/><logic enable='true' value='XOR'/></setState>",
         {255, 255, 0}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        scene.reset();
        resources.reset();
        loadFrame("", paint("red") + row.state + paint("green"));
        CHECK(draw());
        checkNoDiagnostics();
        CHECK(pixel() == row.after);
    }
}

TEST_CASE_FIXTURE(DrawFixture, "State persists from frame to frame") {
    loadFrame("", paint("red") + "<setState><depth enable='false'/></setState>");
    draw();
    CHECK_FALSE(target->framebuffer().state.depth.enabled);
    draw();
    CHECK_FALSE(target->framebuffer().state.depth.enabled);
}

TEST_CASE_FIXTURE(DrawFixture, "setTarget draws into textures and goes back to the screen") {
    loadFrame(R"(<texture2D name="image" internalformat="RGBA8" width="8" height="8" format="RGBA"
                   type="UNSIGNED_BYTE" min="LINEAR_MIPMAP_LINEAR"/>
                 <module name="show" version="330" source="show.glsl">
                   <uniformSampler name="image" texture="image"/></module>)",
              "<setTarget><buffer name='COLOR0' texture='image'/></setTarget>"
              "<setState drawBuffer='COLOR0' clearColor='true'/>" +
                  paint("green") + "<setTarget/>" + paint("show"));
    CHECK(draw());
    checkNoDiagnostics();
    // The smallest mipmap level is green: the levels were made again when the target was left.
    CHECK(pixel() == Colour{0, 255, 0});
    CHECK(pixel(0, 0) == Colour{0, 255, 0});
    CHECK(draw()); // and once more, in the next frame
    CHECK(pixel() == Colour{0, 255, 0});
    checkNoDiagnostics();
}

TEST_CASE_FIXTURE(DrawFixture,
                  "A target that a module's sampler names is what the sampler has now") {
    // Two nodes hand a texture of their own to one program; each frame draws into both.
    const std::string textures =
        R"(<texture2D name="first" internalformat="RGBA8" width="4" height="4" format="RGBA"
             type="UNSIGNED_BYTE"/>
           <texture2D name="second" internalformat="RGBA8" width="4" height="4" format="RGBA"
             type="UNSIGNED_BYTE"/>)";
    for (const bool initial : {true, false}) {
        CAPTURE(initial);
        scene.reset();
        resources.reset();
        load(module("red", R"(x="1" w="1")") + module("green", R"(y="1" w="1")") + textures +
             "<module name='show' version='330' source='show.glsl'>" +
             (initial ? "<uniformSampler name='image' texture='second'/>" : "") +
             "</module>"
             // Behind setProgram the sampler has the texture of the node that runs the method.
             "<sequence name='mark'><setProgram setUniforms='true'><module "
             "name='show'/></setProgram>"
             "<setTarget><buffer name='COLOR0' texture='this.material:image'/></setTarget>"
             "<setState drawBuffer='COLOR0'/><setProgram><module name='this.colour'/></setProgram>"
             "<drawMesh name='quad'/></sequence>"
             "<sequence name='frame'><foreach var='o' flag='object'><callMethod name='$o.mark'/>"
             "</foreach><setTarget/></sequence>"
             "<node name='scene'><node flags='camera'><method id='draw' value='frame'/></node>"
             "<node flags='object'><uniformSampler id='image' texture='first'/><module "
             "id='material' value='show'/><module id='colour' value='red'/><method id='mark' "
             "value='mark'/></node>"
             "<node flags='object'><uniformSampler id='image' texture='second'/><module "
             "id='material' value='show'/><module id='colour' value='green'/><method id='mark' "
             "value='mark'/></node></node>");
        CHECK(draw());
        CHECK(draw());
        checkNoDiagnostics();
        const auto at = [&](const char* texture) {
            const auto pixels = resources->get<Texture>(texture)->download(
                {.level = 0}, {TransferFormat::rgba, TransferType::u8});
            return Colour{int(pixels[0]), int(pixels[1]), int(pixels[2])};
        };
        CHECK(at("first") == Colour{255, 0, 0});
        CHECK(at("second") == Colour{0, 255, 0});
    }
}

TEST_CASE_FIXTURE(DrawFixture, "autoResize gives a target the size of the screen") {
    loadFrame(R"(<texture2D name="image" internalformat="RGBA8" width="8" height="8" format="RGBA"
                   type="UNSIGNED_BYTE"/>)",
              "<setTarget autoResize='true'><buffer name='COLOR0' texture='image'/></setTarget>"
              "<setState drawBuffer='COLOR0'/>" +
                  paint("green") + "<setTarget/>");
    CHECK(draw());
    checkNoDiagnostics();
    CHECK(resources->get<Texture>("image")->width() == kSize);
}

TEST_CASE_FIXTURE(DrawFixture, "setTransforms hands over the frames of the scene") {
    struct Row {
        const char* attribute;
        const char* expression;
    };
    // The camera, whose method this is, stands at (1,2,3); the frame's time is 1000, 10.
    const Row rows[] = {
        {"localToWorld='m'", "float(m[3].xyz == vec3(1,2,3))"},
        {"cameraToWorld='m'", "float(m[3].xyz == vec3(1,2,3))"},
        {"worldToScreen='m'", "float(abs((m * vec4(1,2,2,1)).w - 1.0) < 1e-5)"},
        {"localToScreen='m'", "float(abs((m * vec4(0,0,-1,1)).w - 1.0) < 1e-5)"},
        {"cameraToScreen='m'", "float(m[2].w == -1.0)"},
        {"screenToCamera='m'", "float(abs(m[3].z + 1.0) < 1e-5)"},
        {"worldPos='v'", "float(v == vec3(1,2,3))"},
        {"worldDir='v'", "float(v == vec3(0,0,-1))"},
        {"time='t'", "float(t == vec2(1000, 10))"},
        {"localToScreen='m' screen='this'", "float(m == mat4(1))"},
        {"worldToScreen='m' screen='this'", "float(m[3].xyz == vec3(-1,-2,-3))"},
        {"worldPos='v' module='probe'", "float(v == vec3(1,2,3))"},
        {"worldPos='unknown'", "1.0"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.attribute);
        scene.reset();
        resources.reset();
        write("probe.glsl", "uniform mat4 m; uniform vec3 v; uniform vec2 t;\n#ifdef _FRAGMENT_\n"
                            "layout(location = 0) out vec4 result;\n"
                            "void main() { result = vec4(" +
                                std::string(row.expression) + ", 0, 0, 1); }\n#endif\n");
        loadFrame("<module name='probe' version='330' source='probe.glsl'/>",
                  "<setProgram><module name='probe'/></setProgram><setTransforms " +
                      std::string(row.attribute) + "/><drawMesh name='quad'/>");
        scene->cameraToScreen = glm::perspective(1.0, 1.0, 1.0, 1e9);
        CHECK(draw());
        checkNoDiagnostics();
        CHECK(pixel() == Colour{255, 0, 0});
    }
}

TEST_CASE_FIXTURE(DrawFixture, "drawMesh draws as many instances as it says") {
    write("instances.glsl",
          "#ifdef _VERTEX_\nlayout(location = 0) in vec4 vertex; flat out int id;\n"
          "void main() { id = gl_InstanceID; gl_Position = vec4(vertex.xy, 0.5 - 0.1 * id, 1); }\n"
          "#endif\n#ifdef _FRAGMENT_\nflat in int id; layout(location = 0) out vec4 result;\n"
          "void main() { result = vec4(id == 2, 0, 0, 1); }\n#endif\n");
    loadFrame(
        "<module name='instances' version='330' source='instances.glsl'/>",
        "<setProgram><module name='instances'/></setProgram><drawMesh name='quad' count='3'/>");
    CHECK(draw());
    checkNoDiagnostics();
    CHECK(pixel() == Colour{255, 0, 0});
}

TEST_CASE_FIXTURE(DrawFixture, "Where a setTarget fails nothing is drawn") {
    struct Row {
        const char* name;
        const char* target;
        const char* code;
    };
    const Row rows[] = {
        {"depth as a colour", "<buffer name='COLOR0' texture='depth'/>", "bad-attachment"},
        {"no such level", "<buffer name='COLOR0' texture='image' level='9'/>", "bad-attachment"},
        {"no such texture", "<buffer name='COLOR0' texture='none'/>", "unknown-resource"},
        {"no such value", "<buffer name='COLOR0' texture='this.none'/>", "missing-texture"},
        {"no such sampler", "<buffer name='COLOR0' texture='this.paint:none'/>", "missing-texture"},
        {"a sampler without a texture", "<buffer name='COLOR0' texture='this.show:image'/>",
         "missing-texture"},
        {"no such module", "<buffer name='COLOR0' texture='this.none:image'/>", "missing-texture"},
        {"one with layers, one without",
         "<buffer name='COLOR0' texture='image'/><buffer name='COLOR1' texture='layers' "
         "layer='-1'/>",
         "incomplete-framebuffer"},
        {"nothing to draw into", "<buffer name='NONE' texture='image'/>", "unused-element"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        scene.reset();
        resources.reset();
        diagnostics.clear();
        loadFrame(R"(<texture2D name="image" internalformat="RGBA8" width="8" height="8"
                       format="RGBA" type="UNSIGNED_BYTE"/>
                     <texture2D name="depth" internalformat="DEPTH_COMPONENT24" width="8"
                       height="8" format="DEPTH_COMPONENT" type="UNSIGNED_INT"/>
                     <texture2DArray name="layers" internalformat="RGBA8" width="8" height="16"
                       layers="2" format="RGBA" type="UNSIGNED_BYTE"/>
                     <module name="show" version="330" source="show.glsl"/>)",
                  "<setProgram><module name='show'/></setProgram>" + paint("red") +
                      "<setState><depth/></setState><setTarget>" + row.target +
                      "</setTarget><setState clearColor='true'><clear r='0' g='0' b='1' "
                      "a='1'/></setState>" +
                      paint("green"),
                  "<module id='paint' value='red'/><module id='show' value='show'/>");
        draw();
        draw();
        REQUIRE(codes().size() == 1);
        CHECK(codes()[0].starts_with(row.code));
        CHECK(pixel() == Colour{255, 0, 0});
    }
}

TEST_CASE_FIXTURE(DrawFixture, "setTarget leaves nothing attached, and knows levels and layers") {
    loadFrame(R"(<texture2D name="small" internalformat="RGBA8" width="4" height="4" format="RGBA"
                   type="UNSIGNED_BYTE"/>
                 <texture2D name="large" internalformat="RGBA8" width="8" height="8" format="RGBA"
                   type="UNSIGNED_BYTE" min="NEAREST_MIPMAP_NEAREST"/>
                 <texture2D name="depth" internalformat="DEPTH24_STENCIL8" width="4" height="4"
                   format="DEPTH_STENCIL" type="UNSIGNED_INT"/>
                 <textureCube name="cube" internalformat="RGBA8" width="4" height="24"
                   format="RGBA" type="UNSIGNED_BYTE"/>)",
              "<setTarget><buffer name='COLOR0' texture='small'/><buffer name='DEPTH' "
              "texture='depth'/><buffer name='STENCIL' texture='depth'/></setTarget>"
              "<setState drawBuffer='COLOR0' clearColor='true' clearDepth='true' "
              "clearStencil='true'><clear depth='0' stencil='5'/></setState>"
              // A depth of 4 x 4 that stayed here would cut what is drawn.
              "<setTarget><buffer name='COLOR0' texture='large'/></setTarget>"
              "<setState><depth enable='true'/></setState>" +
                  paint("green") +
                  "<setTarget><buffer name='COLOR0' texture='large' level='1'/></setTarget>" +
                  paint("red") +
                  "<setTarget><buffer name='COLOR0' texture='cube' layer='4'/></setTarget>" +
                  paint("red"));
    CHECK(draw());
    checkNoDiagnostics();
    const auto red = [&](const char* texture, const TextureRegion& at) {
        return int(resources->get<Texture>(texture)->download(
            at, {TransferFormat::red, TransferType::u8})[0]);
    };
    const auto green = [&](const char* texture, const TextureRegion& at) {
        return int(resources->get<Texture>(texture)->download(
            at, {TransferFormat::green, TransferType::u8})[0]);
    };
    CHECK(green("large", {.x = 7, .y = 7}) == 255);
    CHECK(red("large", {.level = 1, .x = 3, .y = 3}) == 255);
    CHECK(green("large", {.level = 1}) == 0);
    CHECK(red("cube", {.z = 4}) == 255);
    CHECK(red("cube", {.z = 3}) == 0);
    const auto stencil = resources->get<Texture>("depth")->download(
        {}, {TransferFormat::depthStencil, TransferType::u24u8});
    CHECK(int(stencil[0]) == 5);
}

TEST_CASE_FIXTURE(DrawFixture, "drawMesh refuses what would never end") {
    write("many.mesh", "0 1 0 1 0 1 points 0 1048576 0");
    loadFrame("", "<setProgram><module name=\"red\"/></setProgram>\n"
                  "<drawMesh name='many' count='1048576'/>");
    draw();
    REQUIRE(codes().size() == 1);
    CHECK(codes()[0] == "too-many 7:30");
}

TEST_CASE_FIXTURE(DrawFixture, "occlusion knows its words") {
    struct Row {
        const char* attributes;
        const char* code;
    };
    const Row rows[] = {{"query='SAMPLES_PASSED' mode='WAIT'", ""},
                        {"query='ANY_SAMPLES_PASSED' mode='REGION_NO_WAIT'", ""},
                        {"query='TIME_STAMP' mode='WAIT'", "unused-attribute"},
                        {"query='SAMPLES' mode='WAIT'", "unknown-word"},
                        {"query='SAMPLES_PASSED' mode='LATER'", "unknown-word"},
                        {"mode='WAIT'", "missing-attribute"}};
    for (const Row& row : rows) {
        CAPTURE(row.attributes);
        scene.reset();
        resources.reset();
        diagnostics.clear();
        loadFrame("", std::string("<setState><occlusion ") + row.attributes + "/></setState>");
        const std::string told = codes().empty() ? "" : codes()[0];
        CHECK(told.substr(0, told.find(' ')) == row.code);
    }
}

TEST_CASE_FIXTURE(DrawFixture, "Nodes of a parallel loop do not draw with one another's state") {
    // Each node paints a column of its own: a viewport, a program, a draw.
    std::string nodes, methods;
    for (int i = 0; i < kSize; ++i) {
        const std::string name = "n" + std::to_string(i);
        methods += "<sequence name='" + name + "'><setState><viewport x='" + std::to_string(i) +
                   "' y='0' width='1' height='16'/></setState>" +
                   paint(i % 3 == 0 ? "green" : "red") + "</sequence>\n";
        nodes += "<node flags='object'><method id='draw' value='" + name + "'/></node>";
    }
    load(module("red", R"(x="1" w="1")") + module("green", R"(y="1" w="1")") + methods +
         "<sequence name='frame'><foreach var='o' flag='object' parallel='true'><callMethod "
         "name='$o.draw'/></foreach></sequence><node name='scene'><node flags='camera'><method "
         "id='draw' value='frame'/></node>" +
         nodes + "</node>");
    for (int frame = 0; frame < 3; ++frame) {
        CHECK(draw());
        for (int i = 0; i < kSize; ++i) {
            CAPTURE(i);
            CHECK(pixel(i, 0) == (i % 3 == 0 ? Colour{0, 255, 0} : Colour{255, 0, 0}));
        }
    }
    checkNoDiagnostics();
}

TEST_CASE_FIXTURE(DrawFixture, "What a program can't draw is told, not sent") {
    write("lines.glsl", "#ifdef _VERTEX_\nlayout(location = 0) in vec4 p; void main() { "
                        "gl_Position = p; }\n#endif\n#ifdef _GEOMETRY_\nlayout(lines) in; "
                        "layout(line_strip, max_vertices = 2) out;\nvoid main() { for (int i = 0; "
                        "i < 2; ++i) { gl_Position = gl_in[i].gl_Position; EmitVertex(); } }\n"
                        "#endif\n#ifdef _FRAGMENT_\nlayout(location = 0) out vec4 c; "
                        "void main() { c = vec4(1); }\n#endif\n");
    write("line.mesh", "0 1 0 1 0 1 linestrip 1 0 2 float false 2 -1 0.0625 1 0.0625 0");
    const std::string module = "<module name='lines' version='330' source='lines.glsl'/>\n";
    loadFrame(module, "<setProgram><module name='lines'/></setProgram><drawMesh name='line'/>");
    CHECK(draw());
    checkNoDiagnostics();
    CHECK(pixel() == Colour{255, 255, 255});
    scene.reset();
    resources.reset();
    loadFrame(module, "<setProgram><module name='lines'/></setProgram>\n<drawMesh name='quad'/>");
    draw();
    draw();
    CHECK(codes() == std::vector<std::string>{"wrong-primitives 8:17"});
}

} // namespace terrane
