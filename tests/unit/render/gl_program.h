// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"
#include "render/state_tracker.h"

#include <doctest/doctest.h>
#include <glad/gl.h>

#include <initializer_list>
#include <string>
#include <utility>

namespace terrane {

/// A program for tests of drawing, made without the module and program classes.
class GlProgram {
public:
    GlProgram(const GlContext& context,
              std::initializer_list<std::pair<unsigned, const char*>> stages)
        : context_(context)
        , name_(context.gl().CreateProgram()) {
        const auto& gl = context.gl();
        for (const auto& [stage, body] : stages) {
            const std::string text = std::string("#version 450 core\n") + body;
            const char* source = text.c_str();
            const unsigned shader = gl.CreateShader(stage);
            gl.ShaderSource(shader, 1, &source, nullptr);
            gl.CompileShader(shader);
            gl.AttachShader(name_, shader);
            gl.DeleteShader(shader);
        }
        gl.LinkProgram(name_);
        GLint linked = 0;
        gl.GetProgramiv(name_, GL_LINK_STATUS, &linked);
        char log[1000] = "";
        gl.GetProgramInfoLog(name_, sizeof log, nullptr, log);
        CAPTURE(std::string(log));
        REQUIRE(linked);
    }
    ~GlProgram() {
        context_.state().forgetProgram(name_);
        context_.gl().DeleteProgram(name_);
    }
    GlProgram(const GlProgram&) = delete;
    GlProgram& operator=(const GlProgram&) = delete;

    void use() const { context_.state().useProgram(name_); }
    int location(const char* uniform) const {
        return context_.gl().GetUniformLocation(name_, uniform);
    }
    void set(const char* uniform, float x, float y, float z, float w) const {
        context_.gl().ProgramUniform4f(name_, location(uniform), x, y, z, w);
    }
    void set(const char* uniform, int value) const {
        context_.gl().ProgramUniform1i(name_, location(uniform), value);
    }

private:
    const GlContext& context_;
    unsigned name_;
};

/// Draws positions as they are, in the colour of the uniform `colour`.
inline constexpr const char* kPlainVertex =
    "layout(location=0) in vec4 p; void main() { gl_Position = p; }";
inline constexpr const char* kColourFragment =
    "uniform vec4 colour; layout(location=0) out vec4 c; void main() { c = colour; }";

} // namespace terrane
