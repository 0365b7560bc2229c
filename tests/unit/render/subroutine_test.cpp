// SPDX-License-Identifier: BSD-3-Clause
#include "program_fixture.h"

namespace terrane {

namespace {

using R = SubroutineTable::Result;
constexpr ShaderStage kFragment = ShaderStage::fragment;

struct SubroutineFixture : ProgramFixture {
    /// Two functions, a uniform and an array of two that choose among them, and what else is said.
    std::string text(const std::string& more = "") {
        return "subroutine float Shape(float x);\n"
               "subroutine(Shape) float twice(float x) { return 2.0 * x; }\n"
               "subroutine(Shape) float squared(float x) { return x * x; }\n"
               "subroutine uniform Shape one;\nsubroutine uniform Shape pair[2];\n" +
               more +
               "layout(location = 0) out vec4 c;\n"
               "void main() { c = vec4(one(3.0), pair[0](4.0), pair[1](5.0), 1.0); }\n";
    }
};

} // namespace

TEST_CASE_FIXTURE(SubroutineFixture, "Subroutine uniforms choose functions by name") {
    const auto program = link(fragment(text(), 400));
    REQUIRE(program);
    SubroutineTable& table = program->subroutines();
    CHECK(table.functions(kFragment, "one") == std::vector<std::string>{"twice", "squared"});
    struct Row {
        const char* uniform;
        const char* function;
        R result;
        glm::vec4 shown;
    };
    const Row rows[] = {
        {"one", "squared", R::done, {9, 8, 10, 1}},
        {"one", "twice", R::done, {6, 8, 10, 1}},
        {"pair[1]", "squared", R::done, {6, 8, 25, 1}},
        {"pair", "squared", R::done, {6, 16, 25, 1}}, // its first element
        {"one", "thrice", R::noFunction, {6, 16, 25, 1}},
        {"none", "twice", R::noUniform, {6, 16, 25, 1}},
        {"pair[2]", "twice", R::noUniform, {6, 16, 25, 1}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.uniform);
        CAPTURE(row.function);
        CHECK(table.choose(kFragment, row.uniform, row.function) == row.result);
        CHECK(draw(*program) == row.shown);
    }
    CHECK(table.choose(ShaderStage::vertex, "one", "squared") == R::noUniform);
    CHECK(table.chosen(kFragment, "pair[1]") == "squared");
    CHECK(table.chosen(kFragment, "none") == "");
    // Another program in between makes OpenGL forget.
    const auto other = shows("", "vec4(0)");
    draw(*other);
    CHECK(draw(*program) == glm::vec4(6, 16, 25, 1));
}

TEST_CASE_FIXTURE(SubroutineFixture,
                  "A chosen function survives a reload, and its uniform's absence") {
    auto program = link(fragment(text(), 400));
    const auto replace = [&](std::shared_ptr<Program> fresh) {
        fresh->inheritValues(*program);
        program = std::move(fresh);
    };
    program->subroutines().choose(kFragment, "one", "squared");
    CHECK(draw(*program).x == 9);
    replace(link(fragment(text("uniform float more;\n"), 400)));
    CHECK(draw(*program).x == 9);
    replace(link(fragment("layout(location = 0) out vec4 c; void main() { c = vec4(0); }", 400)));
    CHECK(draw(*program).x == 0);
    CHECK(program->subroutines().empty());
    replace(link(fragment(text(), 400)));
    CHECK(draw(*program) == glm::vec4(9, 8, 10, 1));
}

TEST_CASE_FIXTURE(SubroutineFixture, "Modules choose functions to start with") {
    ModuleSource m = fragment(text(), 400);
    const Place place{files["archive.xml"], 3};
    m.subroutines = {{"one", "squared", kFragment, place},
                     {"pair[1]", "squared", kFragment, place},
                     {"none", "squared", kFragment, place},
                     {"one", "twice", ShaderStage::geometry, place}};
    const auto program = link(m);
    REQUIRE(program);
    CHECK(draw(*program) == glm::vec4(9, 8, 25, 1));
    CHECK(told() == "");
    const Place wrong{file("wrong.xml", "<archive/>"), 4};
    m.subroutines = {{"one", "square", kFragment, wrong}};
    REQUIRE(link(m));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].suggestion == "squared");
    CHECK(told() == "wrong.xml:1:5 unmatched-uniform\n");
    // What was not chosen by hand follows the module.
    m.subroutines = {{"one", "twice", kFragment, place}};
    const auto edited = link(m);
    edited->inheritValues(*program);
    CHECK(draw(*edited) == glm::vec4(6, 8, 10, 1));
}

} // namespace terrane
