// SPDX-License-Identifier: BSD-3-Clause
#include "render/transform_feedback.h"

#include "program_fixture.h"
#include "render/query.h"

#include <array>
#include <cstring>

namespace terrane {

namespace {

struct FeedbackFixture : ProgramFixture {
    /// Captures the corners of a quad, half as large, into separate buffers or one.
    std::shared_ptr<Program> capturing(FeedbackMode mode) {
        ModuleSource m = source("m", "#ifdef _VERTEX_\nlayout(location = 0) in vec4 p;\n"
                                     "out vec4 corner; out float sum;\n"
                                     "void main() { gl_Position = corner = vec4(p.xy * 0.5, p.zw); "
                                     "sum = p.x + p.y; }\n#endif\n");
        m.feedback = Feedback{.mode = mode, .varyings = {"corner", "sum"}, .place = {}};
        return link(std::move(m));
    }
    std::shared_ptr<Buffer> buffer() {
        auto result = std::make_shared<Buffer>(*context);
        result->allocate(80); // four vertices of both
        return result;
    }
    template <std::size_t N>
    std::array<float, N> read(const Buffer& buffer) {
        std::array<float, N> numbers{};
        buffer.read(0, std::as_writable_bytes(std::span(numbers)));
        return numbers;
    }
    /// The quad as points.
    Mesh points() {
        MeshData data = makeQuadMesh();
        data.mode = PrimitiveMode::points;
        return {*context, data};
    }
};

} // namespace

TEST_CASE_FIXTURE(FeedbackFixture, "A feedback captures what vertices put out, and counts it") {
    const auto program = capturing(FeedbackMode::separate);
    REQUIRE(program);
    TransformFeedback feedback(*context);
    const auto corners = buffer();
    const auto sums = buffer();
    feedback.setBuffer(0, corners);
    feedback.setBuffer(1, sums);
    Query written(*context, QueryKind::feedbackPrimitivesWritten);
    Query generated(*context, QueryKind::primitivesGenerated);
    const Mesh mesh = points();
    program->use();
    written.begin();
    generated.begin();
    feedback.begin(PrimitiveMode::points, false);
    mesh.draw({.count = 2});
    feedback.pause();
    mesh.draw({.first = 2, .count = 1}); // not captured
    feedback.resume();
    mesh.draw({.first = 3, .count = 1});
    feedback.end();
    generated.end();
    written.end();
    CHECK(written.result() == 3);
    CHECK(generated.result() == 4);
    CHECK(read<3>(*sums) == std::array<float, 3>{-2, 0, 2});
    CHECK(read<12>(*corners) ==
          std::array<float, 12>{-0.5, -0.5, 0, 1, 0.5, -0.5, 0, 1, 0.5, 0.5, 0, 1});
}

TEST_CASE_FIXTURE(FeedbackFixture,
                  "What was captured is drawn: its buffer, or the feedback itself") {
    const auto capture = capturing(FeedbackMode::interleaved);
    REQUIRE(capture);
    TransformFeedback feedback(*context);
    const auto captured = buffer();
    feedback.setBuffer(0, captured);
    const Mesh corners = points();
    capture->use();
    feedback.begin(PrimitiveMode::points, false);
    corners.draw();
    feedback.end();

    const std::array attributes{VertexAttribute{.location = 0, .components = 4},
                                VertexAttribute{.location = 1, .components = 1}};
    const Mesh strip(*context, PrimitiveMode::triangleStrip, captured, attributes);
    CHECK(strip.vertexCount() == 4);
    const auto white = shows("", "vec4(1)");
    const auto texture = std::make_shared<Texture>(
        *context, TextureDescription{.format = InternalFormat::r8, .width = 4, .height = 4});
    Framebuffer target(*context);
    target.attach(AttachmentPoint::colour0, {texture});
    target.setDrawBuffers({AttachmentPoint::colour0});
    target.state.viewport = {0, 0, 4, 4};
    for (const bool direct : {false, true}) {
        CAPTURE(direct);
        target.clear(Planes::colour);
        Query samples(*context, QueryKind::samplesPassed);
        white->use();
        samples.begin();
        if (direct)
            strip.drawFeedback(feedback);
        else
            strip.draw();
        samples.end();
        CHECK(samples.result() == 4);
        const auto pixels = texture->download(texture->region());
        for (int i = 0; i < 16; ++i) {
            const bool middle = (i % 4 == 1 || i % 4 == 2) && i >= 4 && i < 12;
            CHECK(int(pixels[std::size_t(i)]) == (middle ? 255 : 0));
        }
    }
}

TEST_CASE_FIXTURE(FeedbackFixture, "A query can be asked without waiting") {
    Query query(*context, QueryKind::anySamplesPassed);
    query.begin();
    query.end();
    context->finish();
    std::optional<std::uint64_t> answer;
    for (int i = 0; i < 1000 && !answer; ++i)
        answer = query.resultIfAvailable();
    CHECK(answer == 0U);
}

} // namespace terrane
