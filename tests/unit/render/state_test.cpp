// SPDX-License-Identifier: BSD-3-Clause
#include "gl_fixture.h"
#include "gl_program.h"
#include "render/mesh.h"
#include "render/render_target.h"

#include <functional>

namespace terrane {

namespace {

/// A 2 x 2 picture with depth and stencil, and a way to draw one colour over it.
struct StateFixture : GlFixture {
    std::shared_ptr<Texture> colour, depthStencil;
    std::unique_ptr<Framebuffer> framebuffer;
    std::unique_ptr<GlProgram> program;
    std::unique_ptr<Mesh> quad;

    StateFixture() {
        colour = std::make_shared<Texture>(*context, TextureDescription{.width = 2, .height = 2});
        depthStencil = std::make_shared<Texture>(
            *context,
            TextureDescription{.format = InternalFormat::depth24Stencil8, .width = 2, .height = 2});
        framebuffer = std::make_unique<Framebuffer>(*context);
        framebuffer->attach(AttachmentPoint::colour0, {colour});
        framebuffer->attach(AttachmentPoint::depth, {depthStencil});
        framebuffer->attach(AttachmentPoint::stencil, {depthStencil});
        framebuffer->setDrawBuffers({AttachmentPoint::colour0});
        framebuffer->setReadBuffer(AttachmentPoint::colour0);
        program = std::make_unique<GlProgram>(
            *context, std::initializer_list<std::pair<unsigned, const char*>>{
                          {GL_VERTEX_SHADER, kPlainVertex}, {GL_FRAGMENT_SHADER, kColourFragment}});
        quad = std::make_unique<Mesh>(*context, makeQuadMesh());
        program->use();
        reset();
    }
    ~StateFixture() {
        quad.reset();
        framebuffer.reset();
        colour.reset();
        depthStencil.reset();
        program.reset();
    }

    PipelineState& state() { return framebuffer->state; }
    void reset() {
        state() = {};
        state().viewport = {0, 0, 2, 2};
        framebuffer->clear(Planes::all);
    }
    void draw(float r, float g, float b, float a) {
        program->set("colour", r, g, b, a);
        framebuffer->use();
        quad->draw();
    }
    std::array<int, 4> pixel(int x, int y) {
        const auto bytes =
            framebuffer->readPixels(x, y, 1, 1, {TransferFormat::rgba, TransferType::u8});
        return {int(bytes[0]), int(bytes[1]), int(bytes[2]), int(bytes[3])};
    }
};

using Pixel = std::array<int, 4>;
constexpr Pixel kRed{255, 0, 0, 255};
constexpr Pixel kBlack{0, 0, 0, 0};

} // namespace

TEST_CASE_FIXTURE(StateFixture, "Each part of the state changes what is drawn") {
    struct Row {
        const char* name;
        std::function<void(PipelineState&)> change;
        Pixel at00, at11;
    };
    using S = PipelineState;
    const std::vector<Row> rows{
        {"defaults", [](S&) {}, kRed, kRed},
        {"viewport",
         [](S& s) {
             s.viewport = {0, 0, 1, 1};
         },
         kRed, kBlack},
        {"scissor",
         [](S& s) {
             s.scissor = {true, {1, 1, 1, 1}};
         },
         kBlack, kRed},
        {"scissor off",
         [](S& s) {
             s.scissor = {false, {1, 1, 1, 1}};
         },
         kRed, kRed},
        {"cull front", [](S& s) { s.polygon.cull = CullFace::front; }, kBlack, kBlack},
        {"cull back", [](S& s) { s.polygon.cull = CullFace::back; }, kRed, kRed},
        {"clockwise front",
         [](S& s) {
             s.polygon.cull = CullFace::back;
             s.polygon.frontIsClockwise = true;
         },
         kBlack, kBlack},
        {"depth never",
         [](S& s) {
             s.depth = {true, CompareFunction::never};
         },
         kBlack, kBlack},
        {"depth less",
         [](S& s) {
             s.depth = {true, CompareFunction::less};
         },
         kRed, kRed},
        {"depth greater",
         [](S& s) {
             s.depth = {true, CompareFunction::greater};
         },
         kBlack, kBlack},
        {"stencil never",
         [](S& s) {
             s.stencil.enabled = true;
             s.stencil.front.function = CompareFunction::never;
         },
         kBlack, kBlack},
        {"stencil of the back",
         [](S& s) {
             s.stencil.enabled = true;
             s.stencil.back.function = CompareFunction::never;
         },
         kRed, kRed},
        {"stencil equal",
         [](S& s) {
             s.stencil.enabled = true;
             s.stencil.front = {CompareFunction::equal, 1};
         },
         kBlack, kBlack},
        {"blend",
         [](S& s) {
             s.blend[0].enabled = true;
             s.blend[0].source = BlendFactor::constantColour;
             s.blendColour = {0.2F, 1, 1, 1};
         },
         {51, 0, 0, 255},
         {51, 0, 0, 255}},
        {"blend of another buffer",
         [](S& s) { s.blend[1] = {.enabled = true, .source = BlendFactor::zero}; }, kRed, kRed},
        {"blend equation",
         [](S& s) { s.blend[0] = {.enabled = true, .equation = BlendEquation::minimum}; },
         {0, 0, 0, 255},
         {0, 0, 0, 255}},
        {"logic",
         [](S& s) {
             s.logic = {true, LogicOperation::invert};
         },
         {255, 255, 255, 255},
         {255, 255, 255, 255}},
        {"logic set off",
         [](S& s) {
             s.logic = {false, LogicOperation::clear};
         },
         kRed, kRed},
        {"colour mask",
         [](S& s) {
             s.write.colour[0] = {false, true, true, true};
         },
         {0, 0, 0, 255},
         {0, 0, 0, 255}},
        {"polygon lines",
         [](S& s) {
             s.polygon.mode = RasterMode::line;
             s.viewport = {-4, -4, 10, 10}; // only the diagonal crosses the picture
         },
         kBlack, kBlack},
        {"clip distances not written", [](S& s) { s.clipDistances = 0; }, kRed, kRed},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        reset();
        row.change(state());
        draw(1, 0, 0, 1);
        CHECK(pixel(0, 0) == row.at00);
        CHECK(pixel(1, 1) == row.at11);
    }
}

TEST_CASE_FIXTURE(StateFixture, "Stencil operations and depth masks write what they should") {
    state().stencil.enabled = true;
    state().stencil.front.depthPass = StencilOperation::replace;
    state().stencil.front.reference = 5;
    state().depth = {true, CompareFunction::less};
    draw(1, 0, 0, 1);
    const TransferLayout stencil{TransferFormat::stencil, TransferType::u8};
    CHECK(framebuffer->readPixels(0, 0, 1, 1, stencil)[0] == std::byte(5));
    // The depth is now that of the quad: drawn again it is not less.
    state().stencil.front.depthFail = StencilOperation::increment;
    draw(0, 1, 0, 1);
    CHECK(pixel(0, 0) == kRed);
    CHECK(framebuffer->readPixels(0, 0, 1, 1, stencil)[0] == std::byte(6));
    // Without the mask a clear leaves the depth as it is.
    state().write.depth = false;
    framebuffer->clear(Planes::depth);
    draw(0, 1, 0, 1);
    CHECK(pixel(0, 0) == kRed);
    state().write.depth = true;
    framebuffer->clear(Planes::depth);
    draw(0, 1, 0, 1);
    CHECK(pixel(0, 0) == Pixel{0, 255, 0, 255});
}

TEST_CASE_FIXTURE(StateFixture, "Polygon offset moves depth") {
    state().depth = {true, CompareFunction::less};
    draw(1, 0, 0, 1);
    state().polygon.polygonOffset = true;
    state().polygon.offsetUnits = -16;
    draw(0, 1, 0, 1);
    CHECK(pixel(0, 0) == Pixel{0, 255, 0, 255});
}

TEST_CASE_FIXTURE(StateFixture, "Each framebuffer keeps its own state") {
    RenderTarget other(*context, 2, 2);
    other.framebuffer().state.write.colour[0] = {false, false, false, false};
    other.framebuffer().state.scissor = {true, {0, 0, 0, 0}};
    draw(1, 0, 0, 1);
    other.framebuffer().use();
    quad->draw();
    draw(0, 0, 1, 1);
    CHECK(pixel(1, 1) == Pixel{0, 0, 255, 255});
    CHECK(other.framebuffer().state.scissor.enabled);
}

TEST_CASE_FIXTURE(StateFixture, "Only differences are sent") {
    auto& tracker = context->state();
    framebuffer->use();
    auto before = tracker.callsSent();
    framebuffer->use();
    framebuffer->use();
    CHECK(tracker.callsSent() == before);
    state().depth.enabled = true;
    framebuffer->use();
    CHECK(tracker.callsSent() == before + 2); // the test and its function
    before = tracker.callsSent();
    program->use();
    CHECK(tracker.callsSent() == before);
    colour->bind(3);
    colour->bind(3);
    CHECK(tracker.callsSent() == before + 1);
    CHECK(tracker.texture(3) == colour->name());
}

TEST_CASE_FIXTURE(StateFixture, "State that foreign code changed is sent again after forget") {
    framebuffer->use();
    const auto& gl = context->gl();
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(0, 0, 0, 0);
    gl.UseProgram(0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
    context->state().forget();
    program->use();
    draw(1, 0, 0, 1);
    CHECK(pixel(0, 0) == kRed);
}

TEST_CASE_FIXTURE(GlFixture, "A texture whose name comes back is bound again") {
    for (int i = 0; i < 3; ++i) {
        const Texture texture(*context, {.width = 1, .height = 1});
        texture.bind(0);
        GLint bound = 0;
        context->gl().GetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
        CHECK(unsigned(bound) == texture.name());
    }
}

} // namespace terrane
