// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"
#include "render/uniform_type.h"

#include <cstddef>
#include <string>
#include <vector>

namespace terrane {

/// A uniform of a linked program. Arrays are told element by element, structures member by member.
struct ActiveUniform {
    std::string name; ///< as the author wrote it: `u[2]`, `s.m`, `u[1].m`, `Block.member`
    const UniformType* type = nullptr;
    int location = -1; ///< outside of blocks
    int block = -1;    ///< index into ProgramInterface::blocks
    std::size_t offset = 0;
    std::size_t matrixStride = 0;
    bool rowMajor = false;
};

struct ActiveBlock {
    std::string name;
    unsigned index = 0; ///< OpenGL's
    std::size_t size = 0;
    int members = 0; ///< array elements counted one by one
};

/// What a linked program can be told.
struct ProgramInterface {
    std::vector<ActiveUniform> uniforms;
    std::vector<ActiveBlock> blocks;
};

/// Asks OpenGL, once after linking.
ProgramInterface readProgramInterface(const GlContext& context, unsigned program);

} // namespace terrane
