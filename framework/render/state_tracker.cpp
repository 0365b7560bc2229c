// SPDX-License-Identifier: BSD-3-Clause
#include "render/state_tracker.h"

#include <glad/gl.h>

#include <cassert>

namespace terrane {

StateTracker::StateTracker(const GladGLContext& gl)
    : gl_(gl) {}

void StateTracker::useProgram(unsigned program) {
    if (program_ == program) return;
    gl_.UseProgram(program);
    program_ = program;
    ++callsSent_;
}

void StateTracker::bindVertexArray(unsigned vertexArray) {
    if (vertexArray_ == vertexArray) return;
    gl_.BindVertexArray(vertexArray);
    vertexArray_ = vertexArray;
    ++callsSent_;
}

void StateTracker::bindDrawFramebuffer(unsigned framebuffer) {
    if (drawFramebuffer_ == framebuffer) return;
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    drawFramebuffer_ = framebuffer;
    ++callsSent_;
}

void StateTracker::bindReadFramebuffer(unsigned framebuffer) {
    if (readFramebuffer_ == framebuffer) return;
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    readFramebuffer_ = framebuffer;
    ++callsSent_;
}

void StateTracker::bindTexture(unsigned unit, unsigned texture) {
    assert(unit < kTextureUnits && "StateTracker::bindTexture(): no such unit");
    if (textures_[unit] == texture) return;
    gl_.BindTextureUnit(unit, texture);
    textures_[unit] = texture;
    ++callsSent_;
}

void StateTracker::bindSampler(unsigned unit, unsigned sampler) {
    assert(unit < kTextureUnits && "StateTracker::bindSampler(): no such unit");
    if (samplers_[unit] == sampler) return;
    gl_.BindSampler(unit, sampler);
    samplers_[unit] = sampler;
    ++callsSent_;
}

void StateTracker::bindUniformBuffer(unsigned binding, unsigned buffer) {
    assert(binding < kUniformBindings && "StateTracker::bindUniformBuffer(): no such binding");
    if (uniformBuffers_[binding] == buffer) return;
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, binding, buffer);
    uniformBuffers_[binding] = buffer;
    ++callsSent_;
}

void StateTracker::forgetTexture(unsigned texture) {
    for (auto& bound : textures_) {
        if (bound == texture) bound = 0;
    }
}

void StateTracker::forgetSampler(unsigned sampler) {
    for (auto& bound : samplers_) {
        if (bound == sampler) bound = 0;
    }
}

void StateTracker::forgetBuffer(unsigned buffer) {
    for (auto& bound : uniformBuffers_) {
        if (bound == buffer) bound = 0;
    }
}

void StateTracker::forgetVertexArray(unsigned vertexArray) {
    if (vertexArray_ == vertexArray) vertexArray_ = 0;
}

void StateTracker::forgetFramebuffer(unsigned framebuffer) {
    if (drawFramebuffer_ == framebuffer) drawFramebuffer_ = 0;
    if (readFramebuffer_ == framebuffer) readFramebuffer_ = 0;
}

void StateTracker::forgetProgram(unsigned program) {
    if (program_ == program) useProgram(0);
}

void StateTracker::forget() {
    gl_.UseProgram(program_ = 0);
    gl_.BindVertexArray(vertexArray_ = 0);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, drawFramebuffer_ = readFramebuffer_ = 0);
    int units = 0;
    gl_.GetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &units);
    unitCount_ = units < int(kTextureUnits) ? unsigned(units) : kTextureUnits;
    gl_.BindTextures(0, GLsizei(unitCount_), nullptr);
    gl_.BindSamplers(0, GLsizei(unitCount_), nullptr);
    int bindings = 0;
    gl_.GetIntegerv(GL_MAX_UNIFORM_BUFFER_BINDINGS, &bindings);
    const int tracked = bindings < int(kUniformBindings) ? bindings : int(kUniformBindings);
    gl_.BindBuffersBase(GL_UNIFORM_BUFFER, 0, tracked, nullptr);
    textures_.fill(0);
    samplers_.fill(0);
    uniformBuffers_.fill(0);
    // Rows are packed tightly everywhere in Terrane; buffers for pixels are not used.
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, 0);
    gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl_.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    gl_.Disable(GL_PRIMITIVE_RESTART);
    gl_.Disable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    gl_.Disable(GL_RASTERIZER_DISCARD);
    gl_.Disable(GL_FRAMEBUFFER_SRGB);
    known_ = false;
    apply(PipelineState{});
}

void StateTracker::enable(unsigned capability, bool on) {
    on ? gl_.Enable(capability) : gl_.Disable(capability);
    ++callsSent_;
}

} // namespace terrane
