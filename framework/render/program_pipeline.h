// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/program.h"

#include <array>
#include <memory>

namespace terrane {

/// Separable programs that draw together, each with its own stages and its own uniforms: two
/// uniforms of one name in two of them are independent. Values are set through the programs.
/// Move-only in spirit, kept where it is; GL thread only.
///
///     ProgramPipeline pipeline(bindings);
///     pipeline.set(vertexProgram); // made with ProgramSource::separable
///     pipeline.set(fragmentProgram);
///     pipeline.use(); // right before the draw
class ProgramPipeline {
public:
    explicit ProgramPipeline(ProgramBindings& bindings);
    ~ProgramPipeline();
    ProgramPipeline(const ProgramPipeline&) = delete;
    ProgramPipeline& operator=(const ProgramPipeline&) = delete;

    /// Takes all stages that a program has from it, in place of the program that had them.
    void set(const std::shared_ptr<Program>& program);
    /// Draws go through its programs from now on, with their values, until a program is used.
    void use();

private:
    ProgramBindings& bindings_;
    unsigned name_ = 0;
    std::array<std::shared_ptr<Program>, kShaderStageCount> programs_;
};

} // namespace terrane
