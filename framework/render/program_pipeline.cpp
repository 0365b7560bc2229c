// SPDX-License-Identifier: BSD-3-Clause
#include "render/program_pipeline.h"

#include "render/state_tracker.h"

#include <glad/gl.h>

#include <algorithm>
#include <cassert>

namespace terrane {

namespace {

constexpr std::array<GLbitfield, kShaderStageCount> kStageBits{
    GL_VERTEX_SHADER_BIT, GL_TESS_CONTROL_SHADER_BIT, GL_TESS_EVALUATION_SHADER_BIT,
    GL_GEOMETRY_SHADER_BIT, GL_FRAGMENT_SHADER_BIT};

} // namespace

ProgramPipeline::ProgramPipeline(ProgramBindings& bindings)
    : bindings_(bindings) {
    bindings.context.gl().CreateProgramPipelines(1, &name_);
    bindings.context.countObject(1);
}

ProgramPipeline::~ProgramPipeline() {
    bindings_.context.gl().DeleteProgramPipelines(1, &name_);
    bindings_.context.countObject(-1);
}

void ProgramPipeline::set(const std::shared_ptr<Program>& program) {
    assert(program->source_.separable && "ProgramPipeline::set(): the program is not separable");
    for (std::size_t i = 0; i < kShaderStageCount; ++i) {
        if (!program->hasStage(kShaderStages[i])) continue;
        programs_[i] = program;
        bindings_.context.gl().UseProgramStages(name_, kStageBits[i], program->name_);
    }
}

void ProgramPipeline::use() {
    bindings_.context.state().useProgram(0); // it would count instead
    bindings_.context.gl().BindProgramPipeline(name_);
    bindings_.textureUnits.beginDraw();
    bindings_.uniformBindings.beginDraw();
    for (auto program = programs_.begin(); program != programs_.end(); ++program) {
        // A program of several stages stands there several times.
        if (*program && std::find(programs_.begin(), program, *program) == program)
            (*program)->bindValues();
    }
}

} // namespace terrane
