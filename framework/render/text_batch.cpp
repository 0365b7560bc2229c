// SPDX-License-Identifier: BSD-3-Clause
#include "render/text_batch.h"

#include "render/framebuffer.h"

#include <glad/gl.h>

#include <algorithm>
#include <array>

namespace terrane {

namespace {

constexpr std::array kAttributes{
    VertexAttribute{.location = 0, .components = 4, .type = VertexType::f32},
    VertexAttribute{.location = 1, .components = 4, .type = VertexType::u8, .normalized = true}};

} // namespace

TextBatch::TextBatch(const GlContext& context)
    : context_(context)
    , buffer_(context)
    , array_(context) {
    static_assert(sizeof(Vertex) == 20, "tightly packed");
    array_.setAttributes(0, buffer_, kAttributes);
}

void TextBatch::begin(const glm::ivec2& targetSize) {
    vertices_.clear();
    toClip_ = 2.0F / glm::vec2(glm::max(targetSize, 1));
}

void TextBatch::add(const Font& font, std::string_view text, const glm::vec2& position, float size,
                    const glm::u8vec4& colour) {
    glm::vec2 pen = position;
    for (const char character : text) {
        const Font::Glyph glyph = font.glyph(static_cast<unsigned char>(character));
        const glm::vec2 low = pen * toClip_ - 1.0F;
        const glm::vec2 high = (pen + size * glm::vec2(glyph.width, 1)) * toClip_ - 1.0F;
        pen.x += size * glyph.advance;
        const Vertex corners[] = {{{low.x, low.y, glyph.left, glyph.bottom}, colour},
                                  {{high.x, low.y, glyph.right, glyph.bottom}, colour},
                                  {{low.x, high.y, glyph.left, glyph.top}, colour},
                                  {{high.x, high.y, glyph.right, glyph.top}, colour}};
        for (const int corner : {0, 1, 2, 2, 1, 3}) // counter-clockwise
            vertices_.push_back(corners[corner]);
    }
}

void TextBatch::draw() {
    if (vertices_.empty()) return;
    buffer_.assign(std::as_bytes(std::span(vertices_)), BufferUsage::stream);
    array_.bind();
    context_.gl().DrawArrays(GL_TRIANGLES, 0, GLsizei(vertices_.size()));
}

void TextBatch::blend(Framebuffer& framebuffer, Program& program, const UniformHandle& sampler,
                      const Font& font) {
    if (empty()) return;
    sampler.set(font.texture());
    auto& blend = framebuffer.state.blend;
    for (auto& buffer : blend) {
        buffer = {.enabled = true,
                  .source = BlendFactor::sourceAlpha,
                  .destination = BlendFactor::oneMinusSourceAlpha,
                  .alphaSource = BlendFactor::sourceAlpha,
                  .alphaDestination = BlendFactor::oneMinusSourceAlpha};
    }
    // Tiles may overlap, and must not hide one another.
    const bool writesDepth = std::exchange(framebuffer.state.write.depth, false);
    framebuffer.use();
    program.use();
    draw();
    framebuffer.state.write.depth = writesDepth;
    for (auto& buffer : blend)
        buffer.enabled = false;
}

} // namespace terrane
