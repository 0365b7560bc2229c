// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/pipeline_state.h"

#include <array>
#include <cstdint>
#include <vector>

struct GladGLContext;

namespace terrane {

/// Remembers what a context has bound and how its pipeline is set up, and sends only what differs.
/// One per GlContext (GlContext::state()); all binding that is not a DSA call goes through it, so
/// that nobody needs to restore anything. Names are OpenGL's; 0 unbinds. GL thread only.
class StateTracker {
public:
    static constexpr unsigned kTextureUnits = 192;   ///< tracked; OpenGL 4.5 guarantees 96
    static constexpr unsigned kUniformBindings = 84; ///< tracked; OpenGL 4.5 guarantees 84

    explicit StateTracker(const GladGLContext& gl);

    void useProgram(unsigned program);
    void bindVertexArray(unsigned vertexArray);
    void bindDrawFramebuffer(unsigned framebuffer);
    void bindReadFramebuffer(unsigned framebuffer);
    void bindTexture(unsigned unit, unsigned texture);
    void bindSampler(unsigned unit, unsigned sampler);
    /// The whole buffer at a uniform block binding point.
    void bindUniformBuffer(unsigned binding, unsigned buffer);
    void apply(const PipelineState& state);

    unsigned program() const { return program_; }
    unsigned drawFramebuffer() const { return drawFramebuffer_; }
    unsigned readFramebuffer() const { return readFramebuffer_; }
    unsigned texture(unsigned unit) const { return textures_[unit]; }

    /// To be called when an object is deleted: OpenGL unbinds it, and its name may come back.
    void forgetTexture(unsigned texture);
    void forgetSampler(unsigned sampler);
    void forgetBuffer(unsigned buffer);
    void forgetVertexArray(unsigned vertexArray);
    void forgetFramebuffer(unsigned framebuffer);
    /// A program in use is taken out of use first, so that it dies at once.
    void forgetProgram(unsigned program);

    /// Sets everything to the known start, to be called after foreign code used the context.
    void forget();

    /// GL calls sent since the start, for tests and metrics.
    std::uint64_t callsSent() const { return callsSent_; }

private:
    void enable(unsigned capability, bool on);
    void sendViewport(const PipelineState& next);
    void sendClear(const PipelineState& next);
    void sendRasterization(const PipelineState& next);
    void sendPolygon(const PipelineState::Polygon& next);
    void sendStencil(const PipelineState::Stencil& next);
    void sendTests(const PipelineState& next);
    void sendBlend(const PipelineState& next);
    void sendMasks(const PipelineState::Masks& next);
    void sendMultisampling(const PipelineState::Multisampling& next);

    const GladGLContext& gl_;
    bool known_ = false; ///< whether pipeline_ is what the context has
    PipelineState pipeline_;
    unsigned program_ = 0;
    unsigned vertexArray_ = 0;
    unsigned drawFramebuffer_ = 0;
    unsigned readFramebuffer_ = 0;
    unsigned unitCount_ = 0;
    std::array<unsigned, kTextureUnits> textures_{};
    std::array<unsigned, kTextureUnits> samplers_{};
    std::array<unsigned, kUniformBindings> uniformBuffers_{};
    std::uint64_t callsSent_ = 0;
};

} // namespace terrane
