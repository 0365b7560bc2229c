// SPDX-License-Identifier: BSD-3-Clause
#include "render/program_bindings.h"

#include "render/state_tracker.h"

#include <glad/gl.h>

#include <algorithm>

namespace terrane {

namespace {

unsigned limit(const GlContext& context, unsigned name, unsigned most) {
    GLint value = 0;
    context.gl().GetIntegerv(name, &value);
    return std::min(static_cast<unsigned>(std::max(value, 1)), most);
}

} // namespace

ProgramBindings::ProgramBindings(const GlContext& c)
    : ProgramBindings(c, limit(c, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, StateTracker::kTextureUnits),
                      limit(c, GL_MAX_UNIFORM_BUFFER_BINDINGS, StateTracker::kUniformBindings)) {}

ProgramBindings::ProgramBindings(const GlContext& c, unsigned textures, unsigned uniforms)
    : context(c)
    , blocks(c)
    , textureUnits(textures)
    , uniformBindings(uniforms) {
    // As many threads as the driver sees fit, for what is compiled and linked without being asked.
    if (c.gl().KHR_parallel_shader_compile) c.gl().MaxShaderCompilerThreadsKHR(~0U);
}

const ShaderObject& ProgramBindings::passThroughVertex() {
    if (!passThroughVertex_) {
        passThroughVertex_.emplace(context, ShaderStage::vertex);
        passThroughVertex_->compile("#version 330\n"
                                    "layout(location = 0) in vec4 terrane_position;\n"
                                    "void main() { gl_Position = terrane_position; }\n");
    }
    return *passThroughVertex_;
}

} // namespace terrane
