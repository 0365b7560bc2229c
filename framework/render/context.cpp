// SPDX-License-Identifier: BSD-3-Clause
#include "render/context.h"

#include "render/state_tracker.h"

#include <glad/gl.h>

#include <string_view>

namespace terrane {

namespace {

void GLAD_API_PTR reportMessage(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei length,
                                const GLchar* text, const void* user) {
    // Compile and link errors are told by whoever compiles, with their places.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    const bool isError = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    if (!isError || severity != GL_DEBUG_SEVERITY_HIGH) return;
    auto* diagnostics = static_cast<Diagnostics*>(const_cast<void*>(user));
    std::string message = length < 0 ? std::string(text) : std::string(text, length);
    while (!message.empty() && message.back() == '\n')
        message.pop_back();
    diagnostics->error("gl-error", {}, std::move(message));
}

bool isSoftwareRenderer(std::string_view renderer) {
    for (std::string_view name : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"}) {
        if (renderer.find(name) != std::string_view::npos) return true;
    }
    return false;
}

/// The thread's current context. Asking the systems does not do: a context that OSMesa makes
/// current also replaces Mesa's EGL context, of which EGL knows nothing.
thread_local GlContext* current = nullptr;

} // namespace

GlContext::GlContext(Diagnostics& diagnostics)
    : diagnostics_(diagnostics)
    , gl_(std::make_unique<GladGLContext>()) {}

GlContext::~GlContext() = default;

void GlContext::makeCurrent() {
    if (enter()) return;
    diagnostics_.error("no-context", {}, std::string(system()) + " can't use its context",
                       "a context that no other thread uses");
}

bool GlContext::enter() {
    if (current == this) return true;
    if (current) current->release();
    current = bind() ? this : nullptr;
    return current == this;
}

bool GlContext::isCurrent() const {
    return current == this;
}

void GlContext::leave() {
    if (current != this) return;
    release();
    current = nullptr;
}

void GlContext::finish() const {
    gl_->Finish();
}

std::string GlContext::initialise(Loader loader, const Options& options) {
    const int version = gladLoadGLContext(gl_.get(), loader);
    if (version == 0) return "no OpenGL functions";
    const auto& gl = *gl_;
    renderer_ = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
    if (version < GLAD_MAKE_VERSION(4, 5)) {
        return "OpenGL " + std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
               std::to_string(GLAD_VERSION_MINOR(version)) + " (" + renderer_ + ")";
    }
    software_ = isSoftwareRenderer(renderer_);

    gl.GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &maxArrayLayers_);
    if (gl.ARB_texture_filter_anisotropic || gl.EXT_texture_filter_anisotropic) {
        gl.GetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &maxAnisotropy_);
    }
    const float cap = options.maxAnisotropy > 0 ? options.maxAnisotropy
                      : software_               ? 1.0F
                                                : maxAnisotropy_;
    maxAnisotropy_ = std::max(1.0F, std::min(maxAnisotropy_, cap));

    if (options.debug) {
        gl.Enable(GL_DEBUG_OUTPUT);
        gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        gl.DebugMessageCallback(reportMessage, &diagnostics_);
    }
    state_ = std::make_unique<StateTracker>(gl);
    state_->forget();
    return {};
}

} // namespace terrane
