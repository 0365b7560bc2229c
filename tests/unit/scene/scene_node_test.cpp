// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_fixture.h"

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace terrane {

namespace {

void checkNear(const glm::dvec3& a, const glm::dvec3& b) {
    CAPTURE(a.x);
    CAPTURE(a.y);
    CAPTURE(a.z);
    CHECK(glm::length(a - b) < 1e-12);
}

glm::dvec3 apply(const SceneNode& node, const glm::dvec3& p) {
    return glm::dvec3(node.localToParent * glm::dvec4(p, 1));
}

} // namespace

TEST_CASE_FIXTURE(SceneFixture, "Transforms multiply in document order, missing ones count as 0") {
    load(R"(<node name="scene">
              <node name="a"><translate x="1"/><rotatez angle="90"/><translate y="2"/></node>
              <node name="b"><rotatex angle="90"/></node>
              <node name="c"><rotatey angle="90"/></node>
            </node>)");
    checkNoDiagnostics();
    // The last one listed is applied first.
    checkNear(apply(*scene->nodes("a")[0], {1, 0, 0}), {-1, 1, 0});
    checkNear(apply(*scene->nodes("b")[0], {0, 1, 0}), {0, 0, 1});
    checkNear(apply(*scene->nodes("c")[0], {0, 0, 1}), {1, 0, 0});
}

TEST_CASE_FIXTURE(SceneFixture, "Bounds replace the box at their place, meshes enlarge it") {
    write("unit.mesh", "0 1 0 1 0 1 points 1 0 3 float false 1 0 0 0 0");
    load(R"(<node name="scene">
              <node name="plain"/>
              <node name="mesh"><mesh id="m" value="unit.mesh"/></node>
              <node name="both"><bounds xmin="5" xmax="6" ymin="5" ymax="6" zmin="5" zmax="6"/>
                <mesh id="m" value="unit.mesh"/></node>
              <node name="replaced"><mesh id="m" value="unit.mesh"/>
                <bounds xmin="5" xmax="6" ymin="5" ymax="6" zmin="5" zmax="6"/></node>
            </node>)");
    checkNoDiagnostics();
    checkNear(scene->nodes("plain")[0]->localBounds.maximum, {0, 0, 0});
    checkNear(scene->nodes("mesh")[0]->localBounds.maximum, {1, 1, 1});
    checkNear(scene->nodes("both")[0]->localBounds.minimum, {0, 0, 0});
    checkNear(scene->nodes("both")[0]->localBounds.maximum, {6, 6, 6});
    checkNear(scene->nodes("replaced")[0]->localBounds.minimum, {5, 5, 5});
}

TEST_CASE_FIXTURE(SceneFixture, "The number of components decides what a value is") {
    load(R"(<node name="scene">
              <uniform4f id="two" x="1" y="2"/>
              <uniform1f id="three" x="1" y="2" z="3" type="INT"/>
              <uniform4f id="gap" x="1" z="3"/>
              <uniform1f id="odd" x="1" type="WHATEVER"/>
              <uniform1f id="two" x="9"/>
            </node>)");
    CHECK(codes() == std::vector<std::string>{"unknown-word 6:47"});
    const auto& values = scene->root()->values;
    CHECK(values.at("two").components == 2);
    CHECK(values.at("two").value[0] == 1); // the first of two with the same id
    CHECK(values.at("three").components == 3);
    CHECK(values.at("three").type == NodeValue::Type::integers);
    CHECK(values.at("gap").components == 1);
    CHECK(values.at("odd").type == NodeValue::Type::doubles);
}

TEST_CASE_FIXTURE(SceneFixture, "Flags and names find nodes in document order") {
    load(R"(<node name="other" flags="x"><node name="inner" flags="x"/></node>
            <node name="scene">
              <node name="first" flags="x,y"/>
              <node value="other" name="ignored"/>
              <node><node name="last" flags="x"/></node>
            </node>)");
    checkNoDiagnostics();
    std::vector<std::string> names;
    for (const SceneNode* node : scene->nodes("x"))
        names.push_back(node->name);
    CHECK(names == std::vector<std::string>{"first", "other", "inner", "last"});
    CHECK(scene->nodes("ignored").empty());
    CHECK(scene->nodes("y").size() == 1);
}

TEST_CASE_FIXTURE(SceneFixture, "Updates compute frames from the root, whose own one is ignored") {
    load(R"(<node name="scene"><translate x="100"/>
              <node name="camera" flags="camera"><translate z="10"/></node>
              <node name="a"><translate x="1"/><node name="b"><translate y="2"/></node></node>
            </node>)");
    scene->cameraToScreen = glm::perspective(1.0, 1.0, 0.1, 1000.0);
    scene->update(0, 0);
    const SceneNode& b = *scene->nodes("b")[0];
    checkNear(b.worldPosition(), {1, 2, 0});
    checkNear(glm::dvec3(b.localToCamera[3]), {1, 2, -10});
    const glm::dvec4 clip = scene->cameraToScreen * glm::dvec4(1, 2, -10, 1);
    CHECK(glm::length(b.localToScreen[3] - clip) < 1e-12);
}

TEST_CASE_FIXTURE(SceneFixture, "A node is invisible only when none of its box can be seen") {
    std::string nodes;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-60, 60), size(0.1, 20);
    for (int i = 0; i < 300; ++i) {
        const double x = place(random), y = place(random), z = place(random), s = size(random);
        nodes += "<node flags=\"box\"><translate x=\"" + std::to_string(x) + "\" y=\"" +
                 std::to_string(y) + "\" z=\"" + std::to_string(z) +
                 "\"/><bounds xmin=\"0\" xmax=\"" + std::to_string(s) + "\" ymin=\"0\" ymax=\"" +
                 std::to_string(s) + "\" zmin=\"0\" zmax=\"" + std::to_string(s) + "\"/></node>\n";
    }
    load("<node name=\"scene\"><node flags=\"camera\"/>" + nodes + "</node>");
    scene->cameraToScreen = glm::perspective(1.2, 1.0, 0.5, 20.0);
    scene->update(0, 0);
    int seen = 0, culled = 0;
    for (const SceneNode* node : scene->nodes("box")) {
        // Brute force: samples of the box against the clip volume without its far plane.
        bool visible = false, all = true;
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 t(i % 10 / 9.0, i / 10 % 10 / 9.0, i / 100 / 9.0);
            const glm::dvec3 p = glm::mix(node->worldBounds.minimum, node->worldBounds.maximum, t);
            const glm::dvec4 c = scene->worldToScreen() * glm::dvec4(p, 1);
            const bool in = std::abs(c.x) < c.w && std::abs(c.y) < c.w && c.z > -c.w;
            visible |= in;
            all &= in;
        }
        if (visible) CHECK(node->visibility != Visibility::none);
        if (node->visibility == Visibility::full) CHECK(all);
        ++(visible ? seen : culled);
    }
    CHECK(seen > 20);
    CHECK(culled > 100);
}

TEST_CASE_FIXTURE(SceneFixture, "Nodes used several times at each level are counted, and bounded") {
    std::string entries = "<node name='n0'/>\n";
    for (int i = 1; i <= 30; ++i) {
        const std::string below = "<node value='n" + std::to_string(i - 1) + "'/>";
        entries += "<node name='n" + std::to_string(i) + "'>" + below + below + "</node>\n";
    }
    load(entries + "<node name='scene'><node value='n30'/></node>");
    CHECK(scene->root()->size <= 100000);
    CHECK(scene->nodes("n0").size() <= 100000);
    scene->update(0, 0);
    // The first that is too much has its place; others follow from it.
    REQUIRE_FALSE(codes().empty());
    CHECK(codes()[0] == "too-many 18:37"); // twice n15, of 65,535 nodes, in n16
    diagnostics.clear();
}

TEST_CASE_FIXTURE(SceneFixture, "Places and angles are finite, values need not be") {
    load("<node name='scene'>\n<translate x='inf'/>\n<rotatex angle='-inf'/>\n"
         "<translate z='1e999'/>\n<uniform2f id='far' x='inf' y='1'/>\n</node>");
    REQUIRE(codes().size() == 3);
    CHECK(codes()[0] == "out-of-range 3:15");
    CHECK(codes()[1] == "out-of-range 4:17");
    CHECK(codes()[2].ends_with(" 5:15"));
    diagnostics.clear();
}

} // namespace terrane
