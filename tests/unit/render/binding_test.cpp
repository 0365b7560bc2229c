// SPDX-License-Identifier: BSD-3-Clause
// Many programs over many textures, samplers and blocks: each draw finds its own at some unit. The
// counts are those of the original's tests (ork reference 7).
#include "program_fixture.h"
#include "render/program_pipeline.h"
#include "render/sampler.h"

#include <array>

namespace terrane {

namespace {

constexpr int kPrograms = 48;
constexpr int kThings = 128;

struct BindingFixture : ProgramFixture {
    /// One pixel of a number.
    std::shared_ptr<const Texture> number(int value) {
        auto texture =
            std::make_shared<Texture>(*context, TextureDescription{.format = InternalFormat::r32f});
        const auto real = float(value);
        texture->upload({TransferFormat::red, TransferType::f32},
                        std::as_bytes(std::span(&real, 1)));
        return texture;
    }
    /// Texture 0 of program 0 is 0, and so on.
    static int thing(int program, int index) { return (program * 4 + index * 29) % kThings; }
    static const char* fourSamplers() {
        return "vec4(texture(s[0], vec2(0)).r, texture(s[1], vec2(0)).r, "
               "texture(s[2], vec2(0)).r, texture(s[3], vec2(0)).r)";
    }
};

} // namespace

TEST_CASE_FIXTURE(BindingFixture, "48 programs read 4 of 128 textures each") {
    std::vector<std::shared_ptr<const Texture>> textures;
    for (int i = 0; i < kThings; ++i)
        textures.push_back(number(i));
    std::vector<std::shared_ptr<Program>> programs;
    const auto module = compile(fragment("uniform sampler2D s[4]; layout(location = 0) out vec4 c; "
                                         "void main() { c = " +
                                         std::string(fourSamplers()) + "; }"));
    for (int p = 0; p < kPrograms; ++p) {
        programs.push_back(link({module}));
        REQUIRE(programs.back());
        for (int i = 0; i < 4; ++i)
            programs.back()->find("s[" + std::to_string(i) + "]").set(textures[thing(p, i)]);
    }
    for (int round = 0; round < 2; ++round) {
        for (int p = 0; p < kPrograms; ++p) {
            CAPTURE(p);
            CHECK(draw(*programs[p]) ==
                  glm::vec4(thing(p, 0), thing(p, 1), thing(p, 2), thing(p, 3)));
        }
    }
    programs.clear();
}

TEST_CASE_FIXTURE(BindingFixture, "48 programs read 8 textures in 128 ways") {
    // What a sampler is can be seen beyond the edge of the texture: its border.
    std::vector<std::shared_ptr<const Texture>> textures;
    for (int i = 0; i < 8; ++i)
        textures.push_back(number(-1));
    std::vector<std::shared_ptr<Sampler>> samplers;
    for (int i = 0; i < kThings; ++i) {
        samplers.push_back(
            std::make_shared<Sampler>(*context, SamplingParameters{.wrapS = Wrap::clampToBorder,
                                                                   .borderType = BorderType::real,
                                                                   .border = glm::dvec4(i)}));
    }
    const auto module = compile(fragment(
        "uniform sampler2D s[4]; layout(location = 0) out vec4 c; void main() { vec2 o = vec2(3, "
        "0); c = vec4(texture(s[0], o).r, texture(s[1], o).r, texture(s[2], o).r, texture(s[3], "
        "o).r); }"));
    std::vector<std::shared_ptr<Program>> programs;
    for (int p = 0; p < kPrograms; ++p) {
        programs.push_back(link({module}));
        for (int i = 0; i < 4; ++i) {
            const UniformHandle sampler = programs[p]->find("s[" + std::to_string(i) + "]");
            sampler.set(textures[(p + i) % 8]);
            sampler.setSampler(samplers[thing(p, i)]);
        }
    }
    for (int round = 0; round < 2; ++round) {
        for (int p = 0; p < kPrograms; ++p) {
            CAPTURE(p);
            CHECK(draw(*programs[p]) ==
                  glm::vec4(thing(p, 0), thing(p, 1), thing(p, 2), thing(p, 3)));
        }
    }
    // Without a sampler the texture's own way counts again.
    programs[0]->find("s[0]").setSampler(nullptr);
    CHECK(draw(*programs[0]).x == -1);
    programs.clear();
}

TEST_CASE_FIXTURE(BindingFixture, "48 programs have 4 of 128 uniform blocks each") {
    const auto block = [](int i) { return "B" + std::to_string(i); };
    std::vector<std::shared_ptr<Program>> programs;
    for (int p = 0; p < kPrograms; ++p) {
        std::string declarations, sum;
        for (int i = 0; i < 4; ++i) {
            const std::string name = block(thing(p, i));
            declarations += "uniform " + name + " { float value; } b" + std::to_string(i) + ";\n";
            sum += (i > 0 ? ", b" : "b") + std::to_string(i) + ".value";
        }
        programs.push_back(shows(declarations, "vec4(" + sum + ")"));
        REQUIRE(programs.back());
    }
    for (int p = 0; p < kPrograms; ++p) {
        for (int i = 0; i < 4; ++i)
            programs[p]->find(block(thing(p, i)) + ".value").set(float(thing(p, i)));
    }
    for (int round = 0; round < 2; ++round) {
        for (int p = 0; p < kPrograms; ++p) {
            CAPTURE(p);
            CHECK(draw(*programs[p]) ==
                  glm::vec4(thing(p, 0), thing(p, 1), thing(p, 2), thing(p, 3)));
        }
    }
    programs.clear();
}

namespace {

struct PipelineFixture : BindingFixture {
    std::shared_ptr<Program> separable(ModuleSource module) {
        ProgramSource program{.name = "p;", .modules = {compile(std::move(module))}};
        program.separable = true;
        return Program::link(*bindings, std::move(program), diagnostics);
    }
    std::shared_ptr<Program> vertexProgram() {
        return separable(source("vertex",
                                "#ifdef _VERTEX_\nuniform float shift;\n"
                                "layout(location = 0) in vec4 p;\n"
                                "layout(location = 3) out float height;\n"
                                "out gl_PerVertex { vec4 gl_Position; };\n"
                                "void main() { gl_Position = p; height = shift; }\n"
                                "#endif\n",
                                450));
    }
    glm::vec4 draw(ProgramPipeline& pipeline) {
        const auto texture = std::make_shared<Texture>(
            *context, TextureDescription{.format = InternalFormat::rgba32f});
        Framebuffer target(*context);
        target.attach(AttachmentPoint::colour0, {texture});
        target.setDrawBuffers({AttachmentPoint::colour0});
        target.state.viewport = {0, 0, 1, 1};
        target.use();
        const Mesh quad(*context, makeQuadMesh());
        pipeline.use();
        quad.draw();
        const auto bytes = texture->download({}, {TransferFormat::rgba, TransferType::f32});
        glm::vec4 pixel;
        std::memcpy(&pixel, bytes.data(), sizeof pixel);
        return pixel;
    }
};

} // namespace

TEST_CASE_FIXTURE(PipelineFixture, "Separable programs draw together, each with its own uniforms") {
    const auto vertex = vertexProgram();
    const auto colour = separable(fragment("uniform float shift; layout(location = 3) in float "
                                           "height; layout(location = 0) out vec4 c;\n"
                                           "void main() { c = vec4(height, shift, 0, 1); }",
                                           450));
    const auto other = separable(fragment("layout(location = 3) in float height; "
                                          "layout(location = 0) out vec4 c;\n"
                                          "void main() { c = vec4(0, 0, height, 1); }",
                                          450));
    REQUIRE(vertex);
    REQUIRE(colour);
    REQUIRE(other);
    vertex->find("shift").set(2.0F);
    colour->find("shift").set(3.0F);
    ProgramPipeline pipeline(*bindings);
    pipeline.set(vertex);
    pipeline.set(colour);
    CHECK(draw(pipeline) == glm::vec4(2, 3, 0, 1));
    vertex->find("shift").set(4.0F);
    CHECK(draw(pipeline) == glm::vec4(4, 3, 0, 1));
    pipeline.set(other);
    CHECK(draw(pipeline) == glm::vec4(0, 0, 4, 1));
}

TEST_CASE_FIXTURE(PipelineFixture, "48 pipelines read 4 of 128 textures each, in 128 ways") {
    std::vector<std::shared_ptr<const Texture>> textures;
    std::vector<std::shared_ptr<Sampler>> samplers;
    for (int i = 0; i < kThings; ++i) {
        textures.push_back(number(i));
        samplers.push_back(std::make_shared<Sampler>(
            *context, SamplingParameters{.wrapS = Wrap::clampToBorder,
                                         .borderType = BorderType::real,
                                         .border = glm::dvec4(1000 + i)}));
    }
    const auto vertex = vertexProgram();
    const auto module = compile(fragment(
        "uniform sampler2D s[4]; layout(location = 3) in float height; layout(location = 0) out "
        "vec4 c; void main() { c = vec4(texture(s[0], vec2(0)).r, texture(s[1], vec2(0)).r, "
        "texture(s[2], vec2(3, 0)).r, texture(s[3], vec2(3, 0)).r); }",
        450));
    std::vector<std::unique_ptr<ProgramPipeline>> pipelines;
    for (int p = 0; p < kPrograms; ++p) {
        ProgramSource source{.name = "p;", .modules = {module}};
        source.separable = true;
        const auto program = Program::link(*bindings, std::move(source), diagnostics);
        REQUIRE(program);
        for (int i = 0; i < 4; ++i) {
            const UniformHandle s = program->find("s[" + std::to_string(i) + "]");
            s.set(textures[thing(p, i)]);
            if (i >= 2) s.setSampler(samplers[thing(p, i)]);
        }
        pipelines.push_back(std::make_unique<ProgramPipeline>(*bindings));
        pipelines.back()->set(vertex);
        pipelines.back()->set(program);
    }
    for (int round = 0; round < 2; ++round) {
        for (int p = 0; p < kPrograms; ++p) {
            CAPTURE(p);
            CHECK(draw(*pipelines[p]) ==
                  glm::vec4(thing(p, 0), thing(p, 1), 1000 + thing(p, 2), 1000 + thing(p, 3)));
        }
    }
    pipelines.clear();
}

} // namespace terrane
