// SPDX-License-Identifier: BSD-3-Clause
#include "gl_fixture.h"
#include "gl_program.h"
#include "render/framebuffer.h"
#include "render/mesh.h"
#include "render/render_target.h"

#include <cstring>

namespace terrane {

namespace {

using Bytes = std::vector<std::byte>;
using P = AttachmentPoint;

constexpr TransferLayout kRgba8{TransferFormat::rgba, TransferType::u8};

Bytes bytes(std::initializer_list<int> values) {
    Bytes result;
    for (int value : values)
        result.push_back(std::byte(value));
    return result;
}

std::shared_ptr<Texture> makeTexture(const GlContext& context, const TextureDescription& d,
                                     const SamplingParameters& sampling = {}) {
    auto texture = std::make_shared<Texture>(context, d, sampling);
    texture->clear();
    return texture;
}

/// The first pixel of a layer.
Bytes firstPixel(const Texture& texture, int layer, int level = 0) {
    return texture.download({.level = level, .z = layer}, kRgba8);
}

float floatOf(const Bytes& pixel) {
    float value = 0;
    std::memcpy(&value, pixel.data(), sizeof value);
    return value;
}

/// A row of the table of attachments: each kind of texture and the layers it has.
struct TargetRow {
    const char* name;
    TextureTarget target;
    int height, depth, layers, z;
};
constexpr TargetRow kTargets[] = {
    {"1D", TextureTarget::texture1D, 1, 1, 1, 1},
    {"1D array", TextureTarget::texture1DArray, 1, 1, 3, 3},
    {"2D", TextureTarget::texture2D, 4, 1, 1, 1},
    {"2D array", TextureTarget::texture2DArray, 4, 1, 3, 3},
    {"3D", TextureTarget::texture3D, 4, 3, 1, 3},
    {"cube", TextureTarget::cube, 4, 1, 1, 6},
    {"cube array", TextureTarget::cubeArray, 4, 1, 2, 12},
    {"rectangle", TextureTarget::rectangle, 4, 1, 1, 1},
};

} // namespace

TEST_CASE_FIXTURE(GlFixture, "One layer of each kind of texture is drawn into") {
    for (const TargetRow& row : kTargets) {
        CAPTURE(row.name);
        const auto texture = makeTexture(*context, {.target = row.target,
                                                    .width = 4,
                                                    .height = row.height,
                                                    .depth = row.depth,
                                                    .layers = row.layers});
        Framebuffer framebuffer(*context);
        framebuffer.attach(P::colour0, {texture, 0, row.z - 1});
        framebuffer.setDrawBuffers({P::colour0});
        CHECK(framebuffer.isComplete(diagnostics, {}));
        framebuffer.state.clear.colour = {1, 0, 0, 1};
        framebuffer.clear(Planes::colour);
        CHECK(firstPixel(*texture, row.z - 1) == bytes({255, 0, 0, 255}));
        if (row.z > 1) CHECK(firstPixel(*texture, row.z - 2) == bytes({0, 0, 0, 0}));
    }
}

TEST_CASE_FIXTURE(GlFixture, "All layers are drawn into at once by a geometry shader") {
    const GlProgram program(
        *context,
        {{GL_VERTEX_SHADER, kPlainVertex},
         {GL_GEOMETRY_SHADER,
          "layout(triangles) in; layout(triangle_strip, max_vertices=36) out; uniform int layers;"
          "flat out int layer; void main() { for (int l = 0; l < layers; ++l) {"
          "for (int i = 0; i < 3; ++i) { gl_Layer = l; layer = l;"
          "gl_Position = gl_in[i].gl_Position; EmitVertex(); } EndPrimitive(); } }"},
         {GL_FRAGMENT_SHADER, "flat in int layer; layout(location=0) out vec4 c;"
                              "void main() { c = vec4((layer + 1) / 255.0, 0, 0, 1); }"}});
    const Mesh quad(*context, makeQuadMesh());
    for (const TargetRow& row : kTargets) {
        if (row.z == 1) continue;
        CAPTURE(row.name);
        const auto texture = makeTexture(*context, {.target = row.target,
                                                    .width = 4,
                                                    .height = row.height,
                                                    .depth = row.depth,
                                                    .layers = row.layers});
        Framebuffer framebuffer(*context);
        framebuffer.attach(P::colour0, {texture, 0, kAllLayers});
        framebuffer.setDrawBuffers({P::colour0});
        framebuffer.state.viewport = {0, 0, 4, row.height};
        CHECK(framebuffer.isComplete(diagnostics, {}));
        framebuffer.use();
        program.set("layers", row.z);
        program.use();
        quad.draw();
        for (int z = 0; z < row.z; ++z) {
            CHECK(firstPixel(*texture, z) == bytes({z + 1, 0, 0, 255}));
        }
    }
}

TEST_CASE_FIXTURE(GlFixture, "The read buffer is copied into a layer of each kind of texture") {
    const auto source = makeTexture(*context, {.width = 4, .height = 4});
    Framebuffer framebuffer(*context);
    framebuffer.attach(P::colour0, {source});
    framebuffer.setDrawBuffers({P::colour0});
    framebuffer.setReadBuffer(P::colour0);
    // Pixel (2, 1) is the only white one.
    source->upload({.x = 2, .y = 1}, kRgba8, bytes({255, 255, 255, 255}));
    for (const TargetRow& row : kTargets) {
        CAPTURE(row.name);
        auto texture = makeTexture(*context, {.target = row.target,
                                              .width = 4,
                                              .height = row.height,
                                              .depth = row.depth,
                                              .layers = row.layers});
        framebuffer.copyTo(*texture, {.x = 1, .z = row.z - 1, .width = 2}, 2, 1);
        const TextureRegion pixel{.x = 1, .z = row.z - 1};
        CHECK(texture->download(pixel, kRgba8) == bytes({255, 255, 255, 255}));
        CHECK(firstPixel(*texture, row.z - 1) == bytes({0, 0, 0, 0}));
    }
}

TEST_CASE_FIXTURE(GlFixture, "Float targets are copied without loss into float storages") {
    const auto source =
        makeTexture(*context, {.format = InternalFormat::rgba32f, .width = 2, .height = 2});
    Framebuffer framebuffer(*context);
    framebuffer.attach(P::colour0, {source});
    framebuffer.setReadBuffer(P::colour0);
    const float values[] = {1234.5F, -2, 3e-5F, 1};
    source->upload({}, {TransferFormat::rgba, TransferType::f32}, std::as_bytes(std::span(values)));
    for (const char* name : {"RGB32F", "RG32F", "R32F", "RGBA32F"}) {
        CAPTURE(name);
        Texture storage(*context, {.target = TextureTarget::texture2DArray,
                                   .format = findInternalFormat(name)->value,
                                   .width = 2,
                                   .height = 2,
                                   .layers = 3});
        framebuffer.copyTo(storage, {.z = 2});
        const Bytes pixel = storage.download({.z = 2});
        CHECK(std::memcmp(pixel.data(), values, pixel.size()) == 0);
    }
}

TEST_CASE_FIXTURE(GlFixture, "Depth and stencil attach at their points and are copied") {
    struct Row {
        const char* format;
        bool stencil;
    };
    for (const Row& row : {Row{"DEPTH_COMPONENT16", false}, Row{"DEPTH_COMPONENT24", false},
                           Row{"DEPTH_COMPONENT32F", false}, Row{"DEPTH24_STENCIL8", true},
                           Row{"DEPTH32F_STENCIL8", true}}) {
        CAPTURE(row.format);
        const auto format = findInternalFormat(row.format)->value;
        const auto depth = makeTexture(*context, {.format = format, .width = 4, .height = 4});
        Framebuffer framebuffer(*context);
        framebuffer.attach(P::depth, {depth});
        if (row.stencil) framebuffer.attach(P::stencil, {depth});
        CHECK(framebuffer.isComplete(diagnostics, {}));
        framebuffer.state.clear.depth = 0.5;
        framebuffer.state.clear.stencil = 7;
        framebuffer.clear(Planes::depth | Planes::stencil);
        const TransferLayout layout{TransferFormat::depth, TransferType::f32};
        CHECK(floatOf(framebuffer.readPixels(1, 1, 1, 1, layout)) == doctest::Approx(0.5));
        if (row.stencil) {
            const TransferLayout stencil{TransferFormat::stencil, TransferType::u8};
            CHECK(framebuffer.readPixels(1, 1, 1, 1, stencil) == bytes({7}));
        }
        const auto copy = makeTexture(*context, {.format = format, .width = 4, .height = 4});
        framebuffer.copyTo(*copy, copy->region());
        CHECK(floatOf(copy->download({.x = 3, .y = 3}, layout)) == doctest::Approx(0.5));
    }
}

TEST_CASE_FIXTURE(GlFixture, "Integer colours are cleared to integer values") {
    for (const char* name : {"R32UI", "R32I", "R8UI", "R16I"}) {
        CAPTURE(name);
        const auto* format = findInternalFormat(name);
        const auto texture =
            makeTexture(*context, {.format = format->value, .width = 2, .height = 2});
        Framebuffer framebuffer(*context);
        framebuffer.attach(P::colour0, {texture});
        framebuffer.setDrawBuffers({P::colour0});
        framebuffer.setReadBuffer(P::colour0);
        framebuffer.state.clear.colour = {42, 0, 0, 0};
        framebuffer.clear(Planes::all);
        CHECK(framebuffer.readPixels(0, 0, 1, 1, format->transfer)[0] == std::byte(42));
    }
}

TEST_CASE_FIXTURE(GlFixture, "Outputs go to the draw buffers in their order") {
    const auto first = makeTexture(*context, {.width = 2, .height = 2});
    const auto second = makeTexture(*context, {.width = 2, .height = 2});
    Framebuffer framebuffer(*context);
    framebuffer.attach(P::colour0, {first});
    framebuffer.attach(P::colour3, {second});
    framebuffer.state.viewport = {0, 0, 2, 2};
    const GlProgram program(
        *context, {{GL_VERTEX_SHADER, kPlainVertex},
                   {GL_FRAGMENT_SHADER, "layout(location=0) out vec4 a;"
                                        "layout(location=1) out vec4 b; void main() {"
                                        "a = vec4(1, 0, 0, 1); b = vec4(0, 1, 0, 1); }"}});
    const Mesh quad(*context, makeQuadMesh());
    program.use();

    framebuffer.use(); // a fresh framebuffer draws into nothing
    quad.draw();
    CHECK(firstPixel(*first, 0) == bytes({0, 0, 0, 0}));

    framebuffer.setDrawBuffers({P::colour0, P::colour3});
    quad.draw();
    CHECK(firstPixel(*first, 0) == bytes({255, 0, 0, 255}));
    CHECK(firstPixel(*second, 0) == bytes({0, 255, 0, 255}));

    framebuffer.setDrawBuffers({P::colour3, P::colour0});
    quad.draw();
    CHECK(firstPixel(*first, 0) == bytes({0, 255, 0, 255}));

    framebuffer.setReadBuffer(P::colour3);
    CHECK(framebuffer.readPixels(0, 0, 1, 1, kRgba8) == bytes({255, 0, 0, 255}));
}

TEST_CASE_FIXTURE(GlFixture, "An attachment follows its texture when that is resized") {
    const auto texture = makeTexture(*context, {.width = 2, .height = 2});
    Framebuffer framebuffer(*context);
    framebuffer.attach(P::colour0, {texture});
    framebuffer.setDrawBuffers({P::colour0});
    framebuffer.state.clear.colour = {1, 1, 1, 1};
    framebuffer.clear(Planes::colour);
    for (const int size : {8, 2, 16}) { // names may come back
        texture->resize(size, size);
        texture->clear();
        framebuffer.clear(Planes::colour);
        CHECK(texture->download({.x = size - 1, .y = size - 1}, kRgba8) ==
              bytes({255, 255, 255, 255}));
    }
}

TEST_CASE_FIXTURE(GlFixture, "A level is drawn into, and mipmaps are made of attached textures") {
    const auto texture =
        makeTexture(*context, {.width = 8, .height = 8}, {.min = MinFilter::linearMipmapLinear});
    Framebuffer framebuffer(*context);
    framebuffer.attach(P::colour0, {texture, 1});
    CHECK(framebuffer.attachment(P::colour0).width() == 4);
    framebuffer.setDrawBuffers({P::colour0});
    framebuffer.state.clear.colour = {0, 0, 1, 1};
    framebuffer.clear(Planes::colour);
    CHECK(firstPixel(*texture, 0, 1) == bytes({0, 0, 255, 255}));
    CHECK(firstPixel(*texture, 0, 0) == bytes({0, 0, 0, 0}));

    framebuffer.attach(P::colour0, {texture, 0});
    framebuffer.state.clear.colour = {0, 1, 0, 1};
    framebuffer.clear(Planes::colour);
    framebuffer.generateMipmaps();
    CHECK(firstPixel(*texture, 0, 3) == bytes({0, 255, 0, 255}));
}

TEST_CASE_FIXTURE(GlFixture, "A framebuffer that can't be drawn into is told") {
    Framebuffer framebuffer(*context);
    CHECK_FALSE(framebuffer.isComplete(diagnostics, {}));
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].code == "incomplete-framebuffer");
    diagnostics.clear();

    framebuffer.attach(P::colour0, {makeTexture(*context, {.width = 2, .height = 2}), 0, 0});
    framebuffer.attach(P::colour1, {makeTexture(*context, {.target = TextureTarget::texture2DArray,
                                                           .width = 2,
                                                           .height = 2,
                                                           .layers = 2}),
                                    0, kAllLayers});
    CHECK_FALSE(framebuffer.isComplete(diagnostics, {}));
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].detail.find("COLOR1: RGBA8, 2 x 2, level 0, layer -1") !=
          std::string::npos);
    diagnostics.clear();

    framebuffer.detach(P::colour1);
    CHECK(framebuffer.isComplete(diagnostics, {}));
}

TEST_CASE_FIXTURE(GlFixture, "Impossible attachments are told apart before they are made") {
    struct Row {
        const char* name;
        const char* format;
        P point;
        int level, layer;
        const char* problem;
    };
    for (const Row& row : {
             Row{"fine", "RGBA8", P::colour0, 0, 0, ""},
             Row{"level", "RGBA8", P::colour0, 1, 0, "level 1 of a texture with 1"},
             Row{"layer", "RGBA8", P::colour0, 0, 2, "layer 2 of a texture with 1"},
             Row{"negative layer", "RGBA8", P::colour0, 0, -2, "layer -2"},
             Row{"depth as colour", "DEPTH_COMPONENT24", P::colour0, 0, 0, "can't be COLOR0"},
             Row{"colour as depth", "RGBA8", P::depth, 0, 0, "can't be DEPTH"},
             Row{"depth as stencil", "DEPTH_COMPONENT24", P::stencil, 0, 0, "can't be STENCIL"},
             Row{"compressed", "COMPRESSED_RGBA", P::colour0, 0, 0, "compressed"},
             Row{"none", "RGBA8", P::none, 0, 0, "NONE"},
         }) {
        CAPTURE(row.name);
        const auto texture = std::make_shared<Texture>(
            *context, TextureDescription{.format = findInternalFormat(row.format)->value,
                                         .width = 4,
                                         .height = 4});
        const std::string problem =
            Framebuffer::problem(row.point, {texture, row.level, row.layer});
        CHECK(problem.find(row.problem) != std::string::npos);
        CHECK(problem.empty() == (std::string(row.problem).empty()));
    }
}

TEST_CASE_FIXTURE(GlFixture, "A blit scales, and is cut by nobody's scissor") {
    RenderTarget small(*context, 2, 2), large(*context, 4, 4);
    small.framebuffer().state.clear.colour = {0.2F, 0.4F, 0.6F, 1};
    small.framebuffer().clear(Planes::all);
    large.framebuffer().state.scissor = {true, {0, 0, 1, 1}};
    large.framebuffer().use();
    small.framebuffer().blit(large.framebuffer(), {0, 0, 2, 2}, {0, 0, 4, 4},
                             Planes::colour | Planes::depth);
    const Image image = large.capture();
    CHECK(image.value(3, 3, 2) == doctest::Approx(0.6).epsilon(0.01));
}

TEST_CASE_FIXTURE(GlFixture, "The render target is resized with its viewport and captured") {
    RenderTarget target(*context, 4, 2);
    CHECK(target.framebuffer().isComplete(diagnostics, {}));
    target.resize(6, 3);
    CHECK(target.width() == 6);
    CHECK(target.height() == 3);
    CHECK(target.framebuffer().state.viewport == PipelineState::Rectangle{0, 0, 6, 3});
    target.framebuffer().state.viewport = {1, 1, 2, 2};
    target.resize(8, 4);
    CHECK(target.framebuffer().state.viewport == PipelineState::Rectangle{1, 1, 2, 2});

    // Row 0 of the picture is the bottom one; buffers of a screen can't be chosen.
    target.framebuffer().setDrawBuffers({});
    target.framebuffer().clear(Planes::all);
    target.framebuffer().state.scissor = {true, {0, 0, 8, 1}};
    target.framebuffer().state.clear.colour = {1, 0, 0, 1};
    target.framebuffer().clear(Planes::colour);
    const Image image = target.captureOpaque();
    CHECK(image.channels == 3);
    CHECK(image.value(0, 0, 0) == 1);
    CHECK(image.value(0, 3, 0) == 0);
    CHECK(target.capture().channels == 4);
}

TEST_CASE_FIXTURE(GlFixture, "Objects of two contexts do not meet") {
    const auto other = createHeadlessContext(diagnostics, {.debug = true});
    REQUIRE(other);
    {
        auto second = std::make_unique<RenderTarget>(*other, 2, 2);
        second->framebuffer().state.clear.colour = {0, 1, 0, 1};
        second->framebuffer().clear(Planes::all);

        context->makeCurrent();
        RenderTarget first(*context, 2, 2);
        first.framebuffer().state.clear.colour = {1, 0, 0, 1};
        first.framebuffer().clear(Planes::all);
        CHECK(first.colour()->name() == second->colour()->name());
        CHECK(first.capture().value(0, 0, 0) == 1);
        CHECK(first.capture().value(0, 0, 1) == 0);

        other->makeCurrent();
        CHECK(second->capture().value(0, 0, 0) == 0);
        CHECK(second->capture().value(0, 0, 1) == 1);
        second.reset();
        CHECK(other->objectCount() == 0);
        context->makeCurrent();
    }
}

} // namespace terrane
