// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"
#include "render/shader_stage.h"

#include <string>

namespace terrane {

/// A shader object of OpenGL. GL thread only.
class ShaderObject {
public:
    ShaderObject(const GlContext& context, ShaderStage stage);
    ~ShaderObject();
    ShaderObject(ShaderObject&& other) noexcept;
    ShaderObject& operator=(ShaderObject&& other) noexcept;

    unsigned name() const { return name_; }
    ShaderStage stage() const { return stage_; }
    /// Starts compiling and asks for nothing, so that the driver may do it in the background.
    void compile(const std::string& text);
    /// Waits for the end. True when it went well; the compiler's words are appended to `log`.
    bool finish(std::string& log) const;

private:
    const GlContext* context_;
    ShaderStage stage_;
    unsigned name_ = 0;
};

} // namespace terrane
