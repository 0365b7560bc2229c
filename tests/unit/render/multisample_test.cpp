// SPDX-License-Identifier: BSD-3-Clause
// Multisample and buffer textures, which only code can make.
#include "program_fixture.h"

#include <array>
#include <cstring>

namespace terrane {

namespace {

using P = AttachmentPoint;
constexpr int kSamples = 4; // guaranteed by OpenGL 4.5

struct MultisampleFixture : ProgramFixture {
    std::shared_ptr<Texture> texture(TextureTarget target, int layers = 1) {
        const TextureDescription description{
            .target = target, .width = 4, .height = 4, .layers = layers, .samples = kSamples};
        REQUIRE(Texture::problem(*context, description) == "");
        auto result = std::make_shared<Texture>(*context, description);
        REQUIRE(result->allocated());
        result->clear();
        return result;
    }
    /// Each sample of the first pixel, red, through a shader.
    std::array<float, kSamples> fetch(const std::shared_ptr<Texture>& texture, int layer = 0) {
        const bool array = texture->zCount() > 1;
        const auto program = shows(
            std::string("uniform sampler2DMS") + (array ? "Array" : "") + " s; uniform int layer;",
            array ? "vec4(texelFetch(s, ivec3(0, 0, layer), 0).r, texelFetch(s, ivec3(0, 0, "
                    "layer), 1).r, texelFetch(s, ivec3(0, 0, layer), 2).r, texelFetch(s, "
                    "ivec3(0, 0, layer), 3).r)"
                  : "vec4(texelFetch(s, ivec2(0), 0).r, texelFetch(s, ivec2(0), 1).r, "
                    "texelFetch(s, ivec2(0), 2).r, texelFetch(s, ivec2(0), 3).r)");
        REQUIRE(program);
        program->find("s").set(*texture);
        if (array) program->find("layer").set(layer);
        const glm::vec4 pixel = draw(*program);
        return {pixel.x, pixel.y, pixel.z, pixel.w};
    }
};

/// The quad, drawn into all layers by a geometry shader if it is to be, with red 1.
std::string painter(int layers) {
    const std::string geometry =
        "#ifdef _GEOMETRY_\nlayout(triangles) in; layout(triangle_strip, max_vertices = 9) out;\n"
        "void main() { for (int l = 0; l < " +
        std::to_string(layers) +
        "; ++l) { for (int i = 0; i < 3; ++i) { gl_Layer = l; gl_Position = "
        "gl_in[i].gl_Position; EmitVertex(); } EndPrimitive(); } }\n#endif\n";
    return "#ifdef _VERTEX_\nlayout(location = 0) in vec4 p; void main() { gl_Position = p; }\n"
           "#endif\n" +
           (layers > 1 ? geometry : "") +
           "#ifdef _FRAGMENT_\nlayout(location = 0) out vec4 c; void main() { c = vec4(1); }\n"
           "#endif\n";
}

} // namespace

TEST_CASE_FIXTURE(MultisampleFixture,
                  "Multisample textures are drawn into, a layer or all, and read by sample") {
    struct Row {
        const char* name;
        TextureTarget target;
        int layers, layer;
        std::array<float, 3> red; ///< of each layer
    };
    const Row rows[] = {
        {"2D", TextureTarget::multisample2D, 1, 0, {1}},
        {"one layer", TextureTarget::multisample2DArray, 3, 1, {0, 1, 0}},
        {"all layers", TextureTarget::multisample2DArray, 3, kAllLayers, {1, 1, 1}},
    };
    const Mesh quad(*context, makeQuadMesh());
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const auto target = texture(row.target, row.layers);
        Framebuffer framebuffer(*context);
        framebuffer.attach(P::colour0, {target, 0, row.layer});
        framebuffer.setDrawBuffers({P::colour0});
        framebuffer.state.viewport = {0, 0, 4, 4};
        REQUIRE(framebuffer.isComplete(diagnostics, {}));
        const auto program =
            link(source("paint", painter(row.layer == kAllLayers ? row.layers : 1)));
        REQUIRE(program);
        framebuffer.use();
        program->use();
        quad.draw();
        for (int layer = 0; layer < row.layers; ++layer) {
            CAPTURE(layer);
            const float red = row.red[std::size_t(layer)];
            CHECK(fetch(target, layer) == std::array{red, red, red, red});
        }
    }
}

TEST_CASE_FIXTURE(MultisampleFixture,
                  "Samples of an edge differ, and a blit makes them one pixel") {
    const auto target = texture(TextureTarget::multisample2D);
    Framebuffer framebuffer(*context);
    framebuffer.attach(P::colour0, {target});
    framebuffer.setDrawBuffers({P::colour0});
    framebuffer.setReadBuffer(P::colour0);
    framebuffer.state.viewport = {0, 0, 4, 4};
    MeshData half = makeQuadMesh(); // its right edge goes through the first column of pixels
    for (const std::size_t vertex : {1, 3}) {
        const float x = -0.75F;
        std::memcpy(half.vertices.data() + vertex * half.stride(), &x, sizeof x);
    }
    const auto program = link(source("paint", painter(1)));
    framebuffer.use();
    program->use();
    Mesh(*context, half).draw();
    const auto samples = fetch(target);
    int covered = 0;
    for (const float sample : samples)
        covered += int(sample);
    CHECK(covered > 0);
    CHECK(covered < kSamples);

    const auto resolved =
        std::make_shared<Texture>(*context, TextureDescription{.width = 4, .height = 4});
    Framebuffer to(*context);
    to.attach(P::colour0, {resolved});
    to.setDrawBuffers({P::colour0});
    framebuffer.blit(to, {0, 0, 4, 4}, {0, 0, 4, 4});
    const auto pixel = resolved->download({}, {TransferFormat::red, TransferType::u8});
    CHECK(std::abs(int(pixel[0]) - 255 * covered / kSamples) <= 1);
}

TEST_CASE_FIXTURE(MultisampleFixture, "Impossible multisample textures are told apart") {
    struct Row {
        const char* problem;
        TextureDescription description;
    };
    const TextureTarget target = TextureTarget::multisample2D;
    const Row rows[] = {
        {"samples a pixel", {.target = target, .samples = 0}},
        {"samples a pixel", {.target = target, .samples = 1000}},
        {"samples a pixel", {.samples = 2}},
        {"levels", {.target = target, .width = 4, .height = 4, .levels = 2, .samples = 2}},
        {"compressed", {.target = target, .format = findInternalFormat("COMPRESSED_RED")->value}},
    };
    for (const Row& row : rows) {
        const std::string problem = Texture::problem(*context, row.description);
        CAPTURE(problem);
        CHECK(problem.find(row.problem) != std::string::npos);
    }
    const auto two = std::make_shared<Texture>(
        *context,
        TextureDescription{.target = target, .width = 4, .height = 4, .samples = kSamples});
    const auto one =
        std::make_shared<Texture>(*context, TextureDescription{.width = 4, .height = 4});
    Framebuffer framebuffer(*context);
    framebuffer.attach(P::colour0, {two});
    framebuffer.attach(P::colour1, {one});
    CHECK_FALSE(framebuffer.isComplete(diagnostics, {}));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].message.find("samples") != std::string::npos);
    diagnostics.clear();
}

TEST_CASE_FIXTURE(MultisampleFixture, "A buffer is read as a texture") {
    const std::array<float, 6> numbers{1, 2, 3, 4, 5, 6};
    const auto buffer = std::make_shared<Buffer>(*context, std::as_bytes(std::span(numbers)));
    const auto texture = std::make_shared<Texture>(*context, InternalFormat::rg32f, buffer);
    CHECK(texture->width() == 3);
    CHECK(Framebuffer::problem(P::colour0, {texture}) != "");
    const auto program =
        shows("uniform samplerBuffer s;", "vec4(texelFetch(s, 0).rg, texelFetch(s, 2).rg)");
    REQUIRE(program);
    program->find("s").set(*texture);
    CHECK(draw(*program) == glm::vec4(1, 2, 5, 6));
}

} // namespace terrane
