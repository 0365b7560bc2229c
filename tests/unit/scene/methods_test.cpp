// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_fixture.h"

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace terrane {

namespace {

// A full-screen program whose colour is a uniform, and what draws with it.
const std::string kCommon = R"(
    <module name="flat" version="330" source="flat.glsl"/>
    <module name="red" version="330" source="red.glsl"/>
    <sequence name="paint">
        <setProgram setUniforms="true"><module name="flat"/></setProgram>
        <drawMesh name="quad"/>
    </sequence>
)";

struct MethodFixture : SceneFixture {
    MethodFixture() {
        write("flat.glsl", "uniform vec3 colour;\n#ifdef _FRAGMENT_\n"
                           "layout(location = 0) out vec4 result;\n"
                           "void main() { result = vec4(colour, 1.0); }\n#endif\n");
        write("red.glsl", "#ifdef _FRAGMENT_\nlayout(location = 0) out vec4 result;\n"
                          "void main() { result = vec4(1, 0, 0, 1); }\n#endif\n");
    }
    // A camera whose method is the given tasks, and more nodes.
    void loadFrame(const std::string& tasks, const std::string& nodes = {}) {
        load(kCommon + "<sequence name=\"frame\">\n" + tasks +
             "\n<setState><depth enable=\"false\"/></setState></sequence>\n"
             "<node name=\"scene\"><node flags=\"camera\"><method id=\"draw\" value=\"frame\"/>"
             "</node>\n" +
             nodes + "</node>");
    }
    static std::string painted(const std::string& name, const std::string& rgb) {
        return "<node name=\"" + name + "\" flags=\"object\"><uniform3f id=\"colour\" " + rgb +
               "/><method id=\"draw\" value=\"paint\"/></node>\n";
    }
};

const std::string kRed = R"(x="1" y="0" z="0")";
const std::string kGreen = R"(x="0" y="1" z="0")";

} // namespace

TEST_CASE_FIXTURE(MethodFixture, "A camera method draws a mesh with a program") {
    loadFrame("<setProgram><module name=\"red\"/></setProgram><drawMesh name=\"quad\"/>");
    CHECK(draw());
    checkNoDiagnostics();
    CHECK(pixel() == Colour{255, 0, 0});
}

TEST_CASE_FIXTURE(MethodFixture, "Loops run in document order: later nodes cover earlier ones") {
    const std::string loop = R"(<setState><depth enable="false"/></setState>
        <foreach var="o" flag="object"><callMethod name="$o.draw"/></foreach>)";
    SUBCASE("red last") {
        loadFrame(loop, painted("a", kGreen) + painted("b", kRed));
        draw();
        CHECK(pixel() == Colour{255, 0, 0});
    }
    SUBCASE("green last") {
        loadFrame(loop, painted("a", kRed) + painted("b", kGreen));
        draw();
        CHECK(pixel() == Colour{0, 255, 0});
    }
    SUBCASE("no node at all") {
        loadFrame(loop);
        draw();
        CHECK(pixel() == Colour{0, 0, 0});
    }
    checkNoDiagnostics();
}

TEST_CASE_FIXTURE(MethodFixture, "Loops with culling leave out what the camera can't see") {
    const std::string hidden =
        "<node flags=\"object\"><translate z=\"50\"/><uniform3f id=\"colour\" " + kRed +
        "/><method id=\"draw\" value=\"paint\"/></node>";
    loadFrame("<foreach var=\"o\" flag=\"object\" culling=\"true\"><callMethod name=\"$o.draw\"/>"
              "</foreach>",
              hidden);
    scene->cameraToScreen = glm::perspective(1.0, 1.0, 0.5, 100.0);
    draw();
    CHECK(pixel() == Colour{0, 0, 0});
    scene->nodes("object")[0]->localToParent[3].z = -50;
    draw();
    CHECK(pixel() == Colour{255, 0, 0});
    checkNoDiagnostics();
}

TEST_CASE_FIXTURE(MethodFixture, "Targets find this, loop variables, flags and names") {
    const std::string node = "<node name=\"thing\" flags=\"f\"><module id=\"m\" value=\"red\"/>"
                             "<mesh id=\"g\" value=\"quad.mesh\"/>"
                             "<method id=\"draw\" value=\"self\"/></node>";
    const std::string self = "<sequence name=\"self\"><setProgram><module name=\"this.m\"/>"
                             "</setProgram><drawMesh name=\"this.g\"/></sequence>";
    std::string tasks;
    SUBCASE("this, in a method called by name") {
        tasks = "<callMethod name=\"thing.draw\"/>";
    }
    SUBCASE("a flag") {
        tasks = "<setProgram><module name=\"f.m\"/></setProgram><drawMesh name=\"f.g\"/>";
    }
    SUBCASE("a loop variable, also after the loop") {
        tasks = "<foreach var=\"v\" flag=\"f\"/><setProgram><module name=\"$v.m\"/></setProgram>"
                "<drawMesh name=\"$v.g\"/>";
    }
    load(kCommon + self + "<sequence name=\"frame\">" + tasks +
         "</sequence><node name=\"scene\"><node flags=\"camera\"><method id=\"draw\" "
         "value=\"frame\"/></node>" +
         node + "</node>");
    CHECK(draw());
    checkNoDiagnostics();
    CHECK(pixel() == Colour{255, 0, 0});
}

TEST_CASE_FIXTURE(MethodFixture, "A disabled method does nothing until it is enabled") {
    loadFrame("<callMethod name=\"thing.draw\"/>",
              "<node name=\"thing\"><uniform3f id=\"colour\" " + kRed +
                  "/><method id=\"draw\" value=\"paint\" enabled=\"false\"/></node>");
    draw();
    CHECK(pixel() == Colour{0, 0, 0});
    scene->nodes("thing")[0]->methods.at("draw").enabled = true;
    draw();
    CHECK(pixel() == Colour{255, 0, 0});
    checkNoDiagnostics();
}

TEST_CASE_FIXTURE(MethodFixture, "What can't be found is told with its place, the rest is drawn") {
    struct Row {
        const char* name;
        const char* task;
        const char* code;
        Colour drawn = {255, 0, 0};
    };
    const Row rows[] = {
        {"unknown node of a call", "<callMethod name=\"nobody.draw\"/>", "unknown-target"},
        {"unknown node of a module", "<setProgram><module name=\"nobody.nothing\"/></setProgram>",
         "unknown-target"},
        {"unknown node of a texture",
         "<setTarget><buffer name=\"COLOR0\" texture=\"nobody.nothing\"/></setTarget>",
         "unknown-target",
         {0, 0, 0}},
        {"call without a target", "<callMethod name=\"draw\"/>", "unknown-target"},
        {"unknown method", "<callMethod name=\"camera.nothing\"/>", "missing-method"},
        {"unknown mesh of a node", "<drawMesh name=\"camera.nothing\"/>", "missing-mesh"},
        {"unknown mesh file", "<drawMesh name=\"nothing\"/>", "file-missing"},
        {"unknown module of a node", "<setProgram><module name=\"camera.m\"/></setProgram>",
         "missing-module"},
        {"unknown module", "<setProgram><module name=\"nothing\"/></setProgram>",
         "unknown-resource"},
        {"unknown texture",
         "<setTarget><buffer name=\"COLOR0\" texture=\"nothing\"/></setTarget>",
         "unknown-resource",
         {0, 0, 0}}, // not on the screen, where it does not belong
        {"method that calls itself", "<callMethod name=\"camera.draw\"/>", "cycle"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        diagnostics.clear();
        scene.reset();
        resources.reset();
        loadFrame(std::string("  ") + row.task +
                  "\n<setProgram><module name=\"red\"/></setProgram><drawMesh name=\"quad\"/>");
        CHECK(draw());
        CHECK(pixel() == row.drawn);
        REQUIRE(!codes().empty());
        CHECK(codes().front().starts_with(row.code));
        CHECK(diagnostics.errors() == 1);
        const std::size_t told = diagnostics.all().size();
        draw(); // is not told again
        CHECK(diagnostics.all().size() == told);
    }
}

TEST_CASE_FIXTURE(MethodFixture,
                  "A misspelt target gets the nearest node, method, mesh or module") {
    struct Row {
        const char* task;
        const char* code;
        const char* suggestion;
    };
    const Row rows[] = {
        {"<callMethod name='camra.other'/>", "unknown-target", "camera.other"},
        {"<callMethod name='ths.other'/>", "unknown-target", "this.other"},
        {"<callMethod name='this.othr'/>", "missing-method", "this.other"},
        {"<callMethod name='this.nothing'/>", "missing-method", ""},
        {"<drawMesh name='this.geometri'/>", "missing-mesh", "this.geometry"},
        {"<setProgram><module name='this.materiel'/></setProgram>", "missing-module",
         "this.material"},
        {"<setTarget><buffer name='COLOR0' texture='this.imag'/></setTarget>", "missing-texture",
         "this.image"},
        {"<drawMesh name='gridskrt'/>", "file-missing", "gridskirt.mesh"},
        {"<drawMesh name='grid25skrt'/>", "file-missing", "grid25skirt.mesh"},
        {"<drawMesh name='qaud'/>", "file-missing", "quad.mesh"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.task);
        diagnostics.clear();
        scene.reset();
        resources.reset();
        load("<sequence name='other'/><module name='red' version='330' source='flat.glsl'/>"
             "<texture2D name='t' internalformat='R8' format='RED' type='UNSIGNED_BYTE' width='1' "
             "height='1'/>"
             "<sequence name='frame'>" +
             std::string(row.task) +
             "</sequence><node name='scene'><node flags='camera'><uniformSampler id='image' "
             "texture='t'/><module id='material' value='red'/><mesh id='geometry' "
             "value='quad.mesh'/><method id='other' value='other'/><method id='draw' "
             "value='frame'/></node></node>");
        scene->plan();
        REQUIRE(diagnostics.all().size() == 1);
        CHECK(diagnostics.all()[0].code == row.code);
        CHECK(diagnostics.all()[0].suggestion == row.suggestion);
    }
}

TEST_CASE_FIXTURE(MethodFixture,
                  "A target without a node falls back to the resource, with a warning") {
    loadFrame("<setProgram><module name=\"nobody.red\"/></setProgram><drawMesh name=\"quad\"/>");
    CHECK(draw());
    CHECK(pixel() == Colour{255, 0, 0});
    REQUIRE(codes().size() == 1);
    CHECK(codes()[0].starts_with("unknown-target"));
    CHECK(diagnostics.errors() == 0);
}

TEST_CASE_FIXTURE(MethodFixture, "Without a camera or its method there is nothing to draw") {
    SUBCASE("no camera") {
        load("<node name=\"scene\"/>");
        CHECK_FALSE(draw());
        CHECK(codes()[0].starts_with("no-camera "));
    }
    SUBCASE("no method") {
        load("<node name=\"scene\"><node flags=\"camera\"/></node>");
        CHECK_FALSE(draw());
        CHECK(codes()[0].starts_with("no-camera-method"));
    }
    CHECK_FALSE(draw());
    CHECK(codes().size() == 1);
}

} // namespace terrane
