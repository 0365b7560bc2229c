// SPDX-License-Identifier: BSD-3-Clause
// The half of StateTracker that sends pipeline state.
#include "render/state_tracker.h"

#include <glad/gl.h>

#include <algorithm>
#include <cmath>

namespace terrane {

static_assert(unsigned(CompareFunction::always) == GL_ALWAYS);
static_assert(unsigned(StencilOperation::decrementWrap) == GL_DECR_WRAP);
static_assert(unsigned(StencilOperation::invert) == GL_INVERT);
static_assert(unsigned(BlendEquation::reverseSubtract) == GL_FUNC_REVERSE_SUBTRACT);
static_assert(unsigned(BlendFactor::oneMinusDestinationColour) == GL_ONE_MINUS_DST_COLOR);
static_assert(unsigned(BlendFactor::oneMinusConstantAlpha) == GL_ONE_MINUS_CONSTANT_ALPHA);
static_assert(unsigned(LogicOperation::set) == GL_SET);
static_assert(unsigned(RasterMode::fill) == GL_FILL);
static_assert(unsigned(CullFace::both) == GL_FRONT_AND_BACK);

void StateTracker::apply(const PipelineState& next) {
    if (known_ && next == pipeline_) return;
    sendViewport(next);
    sendClear(next);
    sendRasterization(next);
    if (!known_ || next.polygon != pipeline_.polygon) sendPolygon(next.polygon);
    sendTests(next);
    if (!known_ || next.stencil != pipeline_.stencil) sendStencil(next.stencil);
    sendBlend(next);
    if (!known_ || next.write != pipeline_.write) sendMasks(next.write);
    if (!known_ || next.multisampling != pipeline_.multisampling) {
        sendMultisampling(next.multisampling);
    }
    if (!known_ || next.dither != pipeline_.dither) enable(GL_DITHER, next.dither);
    pipeline_ = next;
    known_ = true;
}

void StateTracker::sendViewport(const PipelineState& next) {
    if (!known_ || next.viewport != pipeline_.viewport) {
        const auto& viewport = next.viewport;
        gl_.Viewport(viewport.x, viewport.y, std::max(0, viewport.width),
                     std::max(0, viewport.height));
        ++callsSent_;
    }
    if (!known_ || next.depthRange != pipeline_.depthRange) {
        gl_.DepthRange(next.depthRange.near, next.depthRange.far);
        ++callsSent_;
    }
    const unsigned changed = known_ ? next.clipDistances ^ pipeline_.clipDistances : 0xFFU;
    for (unsigned i = 0; i < 8; ++i) { // OpenGL guarantees 8 clip distances
        if (changed >> i & 1U) enable(GL_CLIP_DISTANCE0 + i, next.clipDistances >> i & 1U);
    }
}

void StateTracker::sendClear(const PipelineState& next) {
    if (known_ && next.clear == pipeline_.clear) return;
    const auto& colour = next.clear.colour;
    gl_.ClearColor(colour.r, colour.g, colour.b, colour.a);
    gl_.ClearStencil(next.clear.stencil);
    gl_.ClearDepth(next.clear.depth);
    callsSent_ += 3;
}

void StateTracker::sendRasterization(const PipelineState& next) {
    if (!known_ || next.point != pipeline_.point) {
        enable(GL_PROGRAM_POINT_SIZE, next.point.size <= 0);
        if (next.point.size > 0) gl_.PointSize(next.point.size);
        gl_.PointParameterf(GL_POINT_FADE_THRESHOLD_SIZE, std::max(0.0F, next.point.threshold));
        gl_.PointParameteri(GL_POINT_SPRITE_COORD_ORIGIN,
                            next.point.lowerLeftOrigin ? GL_LOWER_LEFT : GL_UPPER_LEFT);
        callsSent_ += 3;
    }
    if (!known_ || next.line != pipeline_.line) {
        // Wide lines are an error in forward-compatible contexts, so the width is only sent when it
        // is asked for.
        if (next.line.width > 0 && (known_ || next.line.width != 1)) {
            gl_.LineWidth(next.line.width);
        }
        enable(GL_LINE_SMOOTH, next.line.smooth);
        ++callsSent_;
    }
}

void StateTracker::sendPolygon(const PipelineState::Polygon& next) {
    gl_.PolygonMode(GL_FRONT_AND_BACK, unsigned(next.mode));
    gl_.FrontFace(next.frontIsClockwise ? GL_CW : GL_CCW);
    if (next.cull != CullFace::none) gl_.CullFace(unsigned(next.cull));
    gl_.PolygonOffset(next.offsetFactor, next.offsetUnits);
    callsSent_ += 4;
    enable(GL_CULL_FACE, next.cull != CullFace::none);
    enable(GL_POLYGON_SMOOTH, next.smooth);
    enable(GL_POLYGON_OFFSET_POINT, next.pointOffset);
    enable(GL_POLYGON_OFFSET_LINE, next.lineOffset);
    enable(GL_POLYGON_OFFSET_FILL, next.polygonOffset);
}

void StateTracker::sendTests(const PipelineState& next) {
    if (!known_ || next.depth != pipeline_.depth) {
        enable(GL_DEPTH_TEST, next.depth.enabled);
        gl_.DepthFunc(unsigned(next.depth.function));
        ++callsSent_;
    }
    if (!known_ || next.logic != pipeline_.logic) {
        enable(GL_COLOR_LOGIC_OP, next.logic.enabled);
        gl_.LogicOp(unsigned(next.logic.operation));
        ++callsSent_;
    }
    if (!known_ || next.scissor != pipeline_.scissor) {
        const auto& scissor = next.scissor.rectangle;
        enable(GL_SCISSOR_TEST, next.scissor.enabled);
        gl_.Scissor(scissor.x, scissor.y, std::max(0, scissor.width), std::max(0, scissor.height));
        ++callsSent_;
    }
}

void StateTracker::sendStencil(const PipelineState::Stencil& next) {
    enable(GL_STENCIL_TEST, next.enabled);
    const auto send = [this](unsigned face, const PipelineState::StencilFace& values) {
        gl_.StencilFuncSeparate(face, unsigned(values.function), values.reference, values.mask);
        gl_.StencilOpSeparate(face, unsigned(values.fail), unsigned(values.depthFail),
                              unsigned(values.depthPass));
        callsSent_ += 2;
    };
    send(GL_FRONT, next.front);
    send(GL_BACK, next.back);
}

void StateTracker::sendBlend(const PipelineState& next) {
    for (unsigned i = 0; i < kMaxColourBuffers; ++i) {
        const auto& blend = next.blend[i];
        if (known_ && blend == pipeline_.blend[i]) continue;
        blend.enabled ? gl_.Enablei(GL_BLEND, i) : gl_.Disablei(GL_BLEND, i);
        gl_.BlendEquationSeparatei(i, unsigned(blend.equation), unsigned(blend.alphaEquation));
        gl_.BlendFuncSeparatei(i, unsigned(blend.source), unsigned(blend.destination),
                               unsigned(blend.alphaSource), unsigned(blend.alphaDestination));
        callsSent_ += 3;
    }
    if (!known_ || next.blendColour != pipeline_.blendColour) {
        const auto& colour = next.blendColour;
        gl_.BlendColor(colour.r, colour.g, colour.b, colour.a);
        ++callsSent_;
    }
}

void StateTracker::sendMasks(const PipelineState::Masks& next) {
    for (unsigned i = 0; i < kMaxColourBuffers; ++i) {
        const auto& mask = next.colour[i];
        if (known_ && mask == pipeline_.write.colour[i]) continue;
        gl_.ColorMaski(i, mask.red, mask.green, mask.blue, mask.alpha);
        ++callsSent_;
    }
    gl_.DepthMask(next.depth);
    gl_.StencilMaskSeparate(GL_FRONT, next.stencilFront);
    gl_.StencilMaskSeparate(GL_BACK, next.stencilBack);
    callsSent_ += 3;
}

void StateTracker::sendMultisampling(const PipelineState::Multisampling& next) {
    enable(GL_MULTISAMPLE, next.enabled);
    enable(GL_SAMPLE_ALPHA_TO_COVERAGE, next.alphaToCoverage);
    enable(GL_SAMPLE_ALPHA_TO_ONE, next.alphaToOne);
    enable(GL_SAMPLE_COVERAGE, next.coverage < 1);
    gl_.SampleCoverage(std::min(1.0F, std::abs(next.coverage)), next.coverage < 0);
    enable(GL_SAMPLE_MASK, next.mask != ~0U);
    gl_.SampleMaski(0, next.mask);
    enable(GL_SAMPLE_SHADING, next.sampleShading);
    gl_.MinSampleShading(next.minimumShading);
    callsSent_ += 3;
}

} // namespace terrane
