// SPDX-License-Identifier: BSD-3-Clause
#include "render/transform_feedback.h"

#include <glad/gl.h>

#include <cassert>
#include <utility>

namespace terrane {

TransformFeedback::TransformFeedback(const GlContext& context)
    : context_(context) {
    context.gl().CreateTransformFeedbacks(1, &name_);
    context.countObject(1);
}

TransformFeedback::~TransformFeedback() {
    context_.gl().DeleteTransformFeedbacks(1, &name_);
    context_.countObject(-1);
}

void TransformFeedback::setBuffer(unsigned index, std::shared_ptr<Buffer> buffer) {
    assert(index < kMaxBuffers && "TransformFeedback::setBuffer(): no such output");
    context_.gl().TransformFeedbackBufferBase(name_, index, buffer ? buffer->name() : 0);
    buffers_[index] = std::move(buffer);
}

void TransformFeedback::begin(PrimitiveMode primitives, bool rasterize) {
    const bool known = primitives == PrimitiveMode::points || primitives == PrimitiveMode::lines ||
                       primitives == PrimitiveMode::triangles;
    assert(known && "TransformFeedback::begin(): points, lines or triangles");
    const auto& gl = context_.gl();
    rasterizes_ = rasterize;
    if (!rasterize) gl.Enable(GL_RASTERIZER_DISCARD);
    gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, name_);
    if (known) gl.BeginTransformFeedback(unsigned(primitives));
}

void TransformFeedback::pause() {
    context_.gl().PauseTransformFeedback();
    if (!rasterizes_) context_.gl().Disable(GL_RASTERIZER_DISCARD);
    context_.gl().BindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
}

void TransformFeedback::resume() {
    context_.gl().BindTransformFeedback(GL_TRANSFORM_FEEDBACK, name_);
    if (!rasterizes_) context_.gl().Enable(GL_RASTERIZER_DISCARD);
    context_.gl().ResumeTransformFeedback();
}

void TransformFeedback::end() {
    context_.gl().EndTransformFeedback();
    if (!rasterizes_) context_.gl().Disable(GL_RASTERIZER_DISCARD);
    context_.gl().BindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
}

} // namespace terrane
