// SPDX-License-Identifier: BSD-3-Clause
#include "render/shader_object.h"

#include <glad/gl.h>

#include <array>
#include <utility>

namespace terrane {

namespace {

GLenum glStage(ShaderStage stage) {
    constexpr std::array<GLenum, kShaderStageCount> codes{GL_VERTEX_SHADER, GL_TESS_CONTROL_SHADER,
                                                          GL_TESS_EVALUATION_SHADER,
                                                          GL_GEOMETRY_SHADER, GL_FRAGMENT_SHADER};
    return codes[static_cast<std::size_t>(stage)];
}

} // namespace

ShaderObject::ShaderObject(const GlContext& context, ShaderStage stage)
    : context_(&context)
    , stage_(stage)
    , name_(context.gl().CreateShader(glStage(stage))) {
    context.countObject(1);
}

ShaderObject::~ShaderObject() {
    if (name_ == 0) return;
    context_->gl().DeleteShader(name_);
    context_->countObject(-1);
}

ShaderObject::ShaderObject(ShaderObject&& other) noexcept
    : context_(other.context_)
    , stage_(other.stage_)
    , name_(std::exchange(other.name_, 0)) {}

ShaderObject& ShaderObject::operator=(ShaderObject&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(stage_, other.stage_);
    std::swap(name_, other.name_);
    return *this;
}

void ShaderObject::compile(const std::string& text) {
    const GLchar* const start = text.data();
    const auto length = static_cast<GLint>(text.size());
    context_->gl().ShaderSource(name_, 1, &start, &length);
    context_->gl().CompileShader(name_);
}

bool ShaderObject::finish(std::string& log) const {
    const auto& gl = context_->gl();
    GLint good = 0;
    GLint length = 0;
    gl.GetShaderiv(name_, GL_COMPILE_STATUS, &good);
    gl.GetShaderiv(name_, GL_INFO_LOG_LENGTH, &length);
    if (length > 1) {
        std::string words(static_cast<std::size_t>(length), '\0');
        gl.GetShaderInfoLog(name_, length, &length, words.data());
        words.resize(static_cast<std::size_t>(length));
        log += words;
    }
    return good != 0;
}

} // namespace terrane
