// SPDX-License-Identifier: BSD-3-Clause
#include "render/program_interface.h"

#include "render/glsl_legacy.h"

#include <glad/gl.h>

#include <algorithm>
#include <array>

namespace terrane {

namespace {

class InterfaceReader {
public:
    InterfaceReader(const GladGLContext& gl, unsigned program)
        : gl_(gl)
        , program_(program) {}

    ProgramInterface read() {
        const int blocks = count(GL_UNIFORM_BLOCK);
        for (int i = 0; i < blocks; ++i)
            readBlock(static_cast<unsigned>(i));
        const int uniforms = count(GL_UNIFORM);
        for (int i = 0; i < uniforms; ++i)
            readUniform(static_cast<unsigned>(i));
        for (const ActiveUniform& uniform : result_.uniforms) {
            if (uniform.block >= 0) ++result_.blocks[uniform.block].members;
        }
        return std::move(result_);
    }

private:
    int count(GLenum interface) const {
        GLint number = 0;
        gl_.GetProgramInterfaceiv(program_, interface, GL_ACTIVE_RESOURCES, &number);
        return number;
    }

    template <std::size_t N>
    std::array<GLint, N> properties(GLenum interface, unsigned index,
                                    const std::array<GLenum, N>& names) const {
        std::array<GLint, N> values{};
        gl_.GetProgramResourceiv(program_, interface, index, N, names.data(), N, nullptr,
                                 values.data());
        return values;
    }

    std::string name(GLenum interface, unsigned index, int length) const {
        std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
        GLsizei written = 0;
        gl_.GetProgramResourceName(program_, interface, index, length, &written, text.data());
        text.resize(static_cast<std::size_t>(written));
        return text;
    }

    void readBlock(unsigned index) {
        const auto [length, size] =
            properties<2>(GL_UNIFORM_BLOCK, index, {GL_NAME_LENGTH, GL_BUFFER_DATA_SIZE});
        result_.blocks.push_back({.name = originalGlslName(name(GL_UNIFORM_BLOCK, index, length)),
                                  .index = index,
                                  .size = static_cast<std::size_t>(size)});
    }

    void readUniform(unsigned index) {
        const auto [length, code, size, location, block, offset, arrayStride, matrixStride,
                    rowMajor] =
            properties<9>(GL_UNIFORM, index,
                          {GL_NAME_LENGTH, GL_TYPE, GL_ARRAY_SIZE, GL_LOCATION, GL_BLOCK_INDEX,
                           GL_OFFSET, GL_ARRAY_STRIDE, GL_MATRIX_STRIDE, GL_IS_ROW_MAJOR});
        ActiveUniform uniform;
        uniform.name = originalGlslName(name(GL_UNIFORM, index, length));
        uniform.type = &uniformType(static_cast<unsigned>(code));
        // Images and atomic counters are nothing that archives can set.
        if (uniform.type->kind == UniformKind::none) return;
        // OpenGL's own, such as gl_DepthRange.near.
        if (block < 0 && location < 0) return;
        uniform.location = location;
        uniform.block = block;
        uniform.offset = static_cast<std::size_t>(std::max(offset, 0));
        uniform.matrixStride = static_cast<std::size_t>(std::max(matrixStride, 0));
        uniform.rowMajor = rowMajor != 0;
        addElements(std::move(uniform), size, arrayStride);
    }

    // "u[0]" stands for the whole array, whose elements have consecutive locations.
    void addElements(ActiveUniform uniform, int size, int stride) {
        if (!uniform.name.ends_with("[0]")) {
            addToBlocks(uniform);
            return;
        }
        const std::string base = uniform.name.substr(0, uniform.name.size() - 3);
        for (int i = 0; i < size; ++i) {
            ActiveUniform element = uniform;
            element.name = base + "[" + std::to_string(i) + "]";
            if (uniform.block < 0) element.location = uniform.location + i;
            element.offset += static_cast<std::size_t>(i) * static_cast<std::size_t>(stride);
            addToBlocks(element);
        }
    }

    // Of an array of blocks `B b[2]`, OpenGL tells the members once, as `B.m` in B[0]; they are
    // `B[0].m`, `B[1].m` here.
    void addToBlocks(const ActiveUniform& uniform) {
        if (uniform.block < 0 || !result_.blocks[uniform.block].name.ends_with("]")) {
            result_.uniforms.push_back(uniform);
            return;
        }
        const std::string base = arrayName(result_.blocks[uniform.block].name);
        for (std::size_t i = 0; i < result_.blocks.size(); ++i) {
            const std::string& block = result_.blocks[i].name;
            if (!block.ends_with("]") || arrayName(block) != base) continue;
            ActiveUniform member = uniform;
            member.block = static_cast<int>(i);
            if (member.name.starts_with(base + "."))
                member.name = block + member.name.substr(base.size());
            result_.uniforms.push_back(std::move(member));
        }
    }

    static std::string arrayName(const std::string& block) {
        return block.substr(0, block.find('['));
    }

    const GladGLContext& gl_;
    unsigned program_;
    ProgramInterface result_;
};

} // namespace

ProgramInterface readProgramInterface(const GlContext& context, unsigned program) {
    return InterfaceReader(context.gl(), program).read();
}

} // namespace terrane
