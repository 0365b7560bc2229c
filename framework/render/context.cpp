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

} // namespace

GlContext::GlContext(Diagnostics& diagnostics)
    : diagnostics_(diagnostics)
    , gl_(std::make_unique<GladGLContext>()) {}

GlContext::~GlContext() = default;

void GlContext::finish() const {
    gl_->Finish();
}

bool GlContext::initialise(Loader loader, const Options& options) {
    const int version = gladLoadGLContext(gl_.get(), loader);
    if (version < GLAD_MAKE_VERSION(4, 5)) {
        diagnostics_.error("gl-version", {},
                           "the driver offers OpenGL " +
                               std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                               std::to_string(GLAD_VERSION_MINOR(version)),
                           "OpenGL 4.5 core");
        return false;
    }
    const auto& gl = *gl_;
    renderer_ = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
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
    return true;
}

} // namespace terrane
