// SPDX-License-Identifier: BSD-3-Clause
#include "program_fixture.h"

#include "render/buffer.h"
#include "render/render_target.h"
#include "render/state_tracker.h"

#include <glad/gl.h>

namespace terrane {

namespace {

const std::string kWhite = "layout(location = 0) out vec4 c;\nvoid main() { c = vec4(1); }\n";

} // namespace

TEST_CASE_FIXTURE(ProgramFixture, "A program without vertex stage passes attribute 0 through") {
    const auto program = link(fragment(kWhite));
    REQUIRE(program);
    CHECK(draw(*program) == glm::vec4(1));
}

TEST_CASE_FIXTURE(ProgramFixture, "Modules are linked together, libraries too") {
    const auto library = compile(
        source("library", "#ifdef _FRAGMENT_\nvec4 colour() { return vec4(4, 3, 2, 1); }\n#endif"));
    const auto user = compile(fragment("vec4 colour();\nlayout(location = 0) out vec4 c;\n"
                                       "void main() { c = colour(); }\n"));
    const auto program = link({library, user});
    REQUIRE(program);
    CHECK(draw(*program) == glm::vec4(4, 3, 2, 1));
    REQUIRE(library->programs().size() == 1);
    CHECK(library->programs()[0] == program.get());
    const auto second = link({user, library});
    REQUIRE(second);
    CHECK(library->programs().size() == 2);
}

TEST_CASE_FIXTURE(ProgramFixture, "Modules forget a program that dies") {
    const auto module = compile(fragment(kWhite));
    {
        const auto program = link(std::vector{module});
        REQUIRE(module->programs().size() == 1);
        program->use();
    }
    CHECK(module->programs().empty());
    CHECK(context->state().program() == 0);
}

TEST_CASE_FIXTURE(ProgramFixture,
                  "What does not link is told where it stands, or else at the program") {
    SUBCASE("an undefined function") {
        CHECK_FALSE(link(fragment("vec4 missing();\nout vec4 c;\nvoid main() { c = missing(); }")));
        CHECK(told() == "fragment.glsl:1:6 glsl-link\n");
    }
    SUBCASE("no main function") {
        CHECK_FALSE(link(fragment("float f() { return 1.0; }")));
        CHECK(told() == "archive.xml:1:1 glsl-link\n");
    }
    SUBCASE("no stage") {
        CHECK_FALSE(link(source("m", "float f;")));
        CHECK(told() == "archive.xml:1:1 glsl-link\n");
    }
    SUBCASE("a module that does not compile") {
        const auto bad = Module::start(*context, fragment("void main() { nothing; }"), diagnostics);
        REQUIRE(bad);
        CHECK_FALSE(link(std::vector{bad}));
        CHECK(told() == "fragment.glsl:1:15 glsl-compile\n");
    }
}

TEST_CASE_FIXTURE(ProgramFixture, "Started programs can be finished later") {
    const auto first = Module::start(*context, fragment(kWhite), diagnostics);
    const auto program = Program::start(
        *bindings, ProgramSource{.name = "p;", .place = {}, .modules = {first}}, diagnostics);
    REQUIRE(program);
    CHECK(program->finish(diagnostics));
    CHECK(program->finish(diagnostics));
    CHECK(draw(*program) == glm::vec4(1));
}

TEST_CASE_FIXTURE(ProgramFixture, "Feedback captures varyings") {
    ModuleSource m = source("m", R"(
#ifdef _VERTEX_
layout(location = 0) in vec4 p;
out vec2 doubled;
out float sum;
void main() { gl_Position = p; doubled = p.xy * 2.0; sum = p.x + p.y; }
#endif
)");
    struct Row {
        FeedbackMode mode;
        std::vector<float> first, second;
    };
    // Not every context has a framebuffer of its own.
    const RenderTarget target(*context, 1, 1);
    target.framebuffer().use();
    const Row rows[] = {{FeedbackMode::interleaved, {-2, -2, -2, 2, -2, 0}, {}},
                        {FeedbackMode::separate, {-2, -2, 2, -2}, {-2, 0}}};
    for (const Row& row : rows) {
        CAPTURE(int(row.mode));
        m.feedback = Feedback{.mode = row.mode, .varyings = {"doubled", "sum"}, .place = {}};
        const auto program = link(m);
        REQUIRE(program);
        const auto& gl = context->gl();
        GLuint buffers[2];
        gl.CreateBuffers(2, buffers);
        for (const GLuint buffer : {buffers[0], buffers[1]})
            gl.NamedBufferStorage(buffer, 256, nullptr, 0);
        gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffers[0]);
        if (!row.second.empty()) gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 1, buffers[1]);
        const Mesh points(*context, [] {
            MeshData data = makeQuadMesh();
            data.mode = PrimitiveMode::points;
            return data;
        }());
        program->use();
        gl.Enable(GL_RASTERIZER_DISCARD);
        gl.BeginTransformFeedback(GL_POINTS);
        points.draw();
        gl.EndTransformFeedback();
        gl.Disable(GL_RASTERIZER_DISCARD);
        const auto read = [&](GLuint buffer, std::size_t count) {
            std::vector<float> values(count);
            gl.GetNamedBufferSubData(buffer, 0, GLsizeiptr(count * sizeof(float)), values.data());
            return values;
        };
        CHECK(read(buffers[0], row.first.size()) == row.first);
        CHECK(read(buffers[1], row.second.size()) == row.second);
        gl.DeleteBuffers(2, buffers);
    }
}

TEST_CASE_FIXTURE(ProgramFixture, "Modules must agree on the feedback mode") {
    ModuleSource a = source("a", "// _VERTEX_\nout float x;\nvoid main() { x = 1.0; }");
    ModuleSource b = fragment(kWhite);
    a.feedback = Feedback{.mode = FeedbackMode::interleaved, .varyings = {"x"}, .place = {}};
    b.feedback = Feedback{.mode = FeedbackMode::separate, .varyings = {"x"}, .place = a.place};
    CHECK_FALSE(link({compile(a), compile(b)}));
    CHECK(told() == "archive.xml:2:3 feedback-modes\n");
}

namespace {

/// What a reload does: a newer version takes over the values, and the older one goes.
void replace(std::shared_ptr<Program>& program, std::shared_ptr<Program> fresh) {
    fresh->inheritValues(*program);
    program = std::move(fresh);
}

} // namespace

TEST_CASE_FIXTURE(ProgramFixture, "Values survive a reload") {
    const auto version = [&](const std::string& declarations, const std::string& colour) {
        auto program = shows(declarations, colour);
        REQUIRE(program);
        return program;
    };
    auto program = version("uniform float a; uniform B { vec2 b; };", "vec4(a, b, 0)");
    program->find("a").set(1.0F);
    program->find("b").set(glm::vec2(2, 3));
    program->find("later").set(9.0F); // not there yet
    CHECK(draw(*program) == glm::vec4(1, 2, 3, 0));

    SUBCASE("of code") {
        replace(program, version("uniform float later; uniform B { vec2 b; }; uniform float a;",
                                 "vec4(a, b, later + 10)"));
        CHECK(draw(*program) == glm::vec4(1, 2, 3, 10));
        program->find("later").set(5.0F);
        program->find("a").set(4.0F);
        CHECK(draw(*program) == glm::vec4(4, 2, 3, 15));
    }
    SUBCASE("that removes a uniform, and one that brings it back") {
        replace(program, version("uniform B { vec2 b; };", "vec4(0, b, 0)"));
        const UniformHandle a = program->find("a");
        CHECK_FALSE(a.active());
        a.set(7.0F);
        CHECK(draw(*program) == glm::vec4(0, 2, 3, 0));
        replace(program, version("uniform B { vec2 b; }; uniform float a;", "vec4(a, b, 0)"));
        CHECK(program->find("a").active());
        CHECK(draw(*program) == glm::vec4(1, 2, 3, 0));
    }
    SUBCASE("that changes a type") {
        replace(program, version("uniform vec2 a; uniform B { vec2 b; };", "vec4(a, b)"));
        CHECK(draw(*program) == glm::vec4(0, 0, 2, 3));
        CHECK(program->find("a").type().name == "vec2");
    }
    SUBCASE("that changes a block") {
        replace(program, version("uniform B { vec4 before; vec2 b; }; uniform float a;",
                                 "vec4(a, b, before.x)"));
        CHECK(draw(*program) == glm::vec4(1, 2, 3, 0));
        program->find("b").set(glm::vec2(5, 6));
        CHECK(draw(*program) == glm::vec4(1, 5, 6, 0));
    }
}

TEST_CASE_FIXTURE(ProgramFixture, "The texture of a sampler survives a reload, and its absence") {
    const auto texture = std::make_shared<Texture>(*context, TextureDescription{});
    const glm::u8vec4 red(255, 0, 0, 255);
    texture->upload({TransferFormat::rgba, TransferType::u8}, std::as_bytes(std::span(&red, 1)));
    auto program = shows("uniform sampler2D s;", "texture(s, vec2(0.5))");
    REQUIRE(program);
    program->find("s").set(std::shared_ptr<const Texture>(texture));
    CHECK(draw(*program) == glm::vec4(1, 0, 0, 1));
    replace(program, shows("", "vec4(0)"));
    CHECK(draw(*program) == glm::vec4(0));
    CHECK(program->find("s").sharedTexture() == nullptr);
    replace(program, shows("uniform float more; uniform sampler2D s;",
                           "texture(s, vec2(0.5)) + vec4(0, more, 0, 0)"));
    CHECK(draw(*program) == glm::vec4(1, 0, 0, 1));
    const UniformHandle sampler = program->find("s");
    CHECK(sampler.sharedTexture() == texture);
    const auto other = std::make_shared<Texture>(*context, TextureDescription{});
    sampler.set(*other); // somebody else keeps it
    CHECK(sampler.texture() == other.get());
    CHECK(sampler.sharedTexture() == nullptr);
    sampler.set(std::shared_ptr<const Texture>(other));
    CHECK(sampler.sharedTexture() == other);
}

TEST_CASE_FIXTURE(ProgramFixture, "An edited initial value shows unless the value was set") {
    const auto version = [&](float initial) {
        ModuleSource m = fragment("uniform float a, b; layout(location = 0) out vec4 c;\n"
                                  "void main() { c = vec4(a, b, 0, 0); }");
        UniformValue value(*findUniformType("float"));
        value.setComponent(0, initial);
        m.uniforms = {{.name = "a", .place = {}, .value = value, .texture = {}},
                      {.name = "b", .place = {}, .value = value, .texture = {}}};
        return link(m);
    };
    auto program = version(1);
    program->find("b").set(7.0F);
    CHECK(draw(*program) == glm::vec4(1, 7, 0, 0));
    replace(program, version(2));
    CHECK(draw(*program) == glm::vec4(2, 7, 0, 0));
}

TEST_CASE_FIXTURE(ProgramFixture, "A steady frame sends nothing again") {
    const auto program = shows("uniform float a; uniform B { float b; }; uniform sampler2D s;",
                               "vec4(a + b) + texture(s, vec2(0))");
    REQUIRE(program);
    Texture texture(*context, {.format = InternalFormat::rgba8});
    texture.clear();
    const UniformHandle a = program->find("a"), b = program->find("b"), s = program->find("s");
    std::uint64_t sent = 0;
    for (int frame = 0; frame < 3; ++frame) {
        a.set(1.0F);
        b.set(2.0F);
        s.set(texture);
        program->use();
        if (frame == 0) sent = context->state().callsSent();
    }
    CHECK(context->state().callsSent() == sent);
}

} // namespace terrane
