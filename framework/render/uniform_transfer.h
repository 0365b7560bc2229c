// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/program_interface.h"
#include "render/uniform_block.h"
#include "render/uniform_type.h"

namespace terrane {

// How values get to uniforms and back.

/// Sends a value to a uniform outside of blocks.
void sendUniform(const GlContext& context, unsigned program, int location,
                 const UniformValue& value);
/// Asks OpenGL for the value of a uniform outside of blocks.
UniformValue fetchUniform(const GlContext& context, unsigned program, const ActiveUniform& uniform);

/// Writes a value where a block's layout has it, and reads it from there.
void writeToBlock(UniformBlock& block, const ActiveUniform& uniform, const UniformValue& value);
UniformValue readFromBlock(const UniformBlock& block, const ActiveUniform& uniform);

} // namespace terrane
