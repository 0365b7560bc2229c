// SPDX-License-Identifier: BSD-3-Clause
#include "render/uniform_transfer.h"

#include <glad/gl.h>

#include <cstring>

namespace terrane {

namespace {

using Gl = GladGLContext;

template <class Scalar>
const Scalar* as(const UniformValue& value) {
    return reinterpret_cast<const Scalar*>(value.data());
}

void sendVector(const Gl& gl, GLuint p, GLint l, const UniformValue& value) {
    const int rows = value.type().rows;
    switch (value.type().kind) {
    case UniformKind::float32: {
        constexpr decltype(&Gl::ProgramUniform1fv) send[]{
            &Gl::ProgramUniform1fv, &Gl::ProgramUniform2fv, &Gl::ProgramUniform3fv,
            &Gl::ProgramUniform4fv};
        return (gl.*send[rows - 1])(p, l, 1, as<GLfloat>(value));
    }
    case UniformKind::float64: {
        constexpr decltype(&Gl::ProgramUniform1dv) send[]{
            &Gl::ProgramUniform1dv, &Gl::ProgramUniform2dv, &Gl::ProgramUniform3dv,
            &Gl::ProgramUniform4dv};
        return (gl.*send[rows - 1])(p, l, 1, as<GLdouble>(value));
    }
    case UniformKind::uint32: {
        constexpr decltype(&Gl::ProgramUniform1uiv) send[]{
            &Gl::ProgramUniform1uiv, &Gl::ProgramUniform2uiv, &Gl::ProgramUniform3uiv,
            &Gl::ProgramUniform4uiv};
        return (gl.*send[rows - 1])(p, l, 1, as<GLuint>(value));
    }
    default: {
        constexpr decltype(&Gl::ProgramUniform1iv) send[]{
            &Gl::ProgramUniform1iv, &Gl::ProgramUniform2iv, &Gl::ProgramUniform3iv,
            &Gl::ProgramUniform4iv};
        return (gl.*send[rows - 1])(p, l, 1, as<GLint>(value));
    }
    }
}

// By columns - 2 and rows - 2.
void sendMatrix(const Gl& gl, GLuint p, GLint l, const UniformValue& value) {
    const int column = value.type().columns - 2;
    const int row = value.type().rows - 2;
    if (value.type().kind == UniformKind::float64) {
        constexpr decltype(&Gl::ProgramUniformMatrix2dv) send[3][3]{
            {&Gl::ProgramUniformMatrix2dv, &Gl::ProgramUniformMatrix2x3dv,
             &Gl::ProgramUniformMatrix2x4dv},
            {&Gl::ProgramUniformMatrix3x2dv, &Gl::ProgramUniformMatrix3dv,
             &Gl::ProgramUniformMatrix3x4dv},
            {&Gl::ProgramUniformMatrix4x2dv, &Gl::ProgramUniformMatrix4x3dv,
             &Gl::ProgramUniformMatrix4dv}};
        return (gl.*send[column][row])(p, l, 1, GL_FALSE, as<GLdouble>(value));
    }
    constexpr decltype(&Gl::ProgramUniformMatrix2fv) send[3][3]{
        {&Gl::ProgramUniformMatrix2fv, &Gl::ProgramUniformMatrix2x3fv,
         &Gl::ProgramUniformMatrix2x4fv},
        {&Gl::ProgramUniformMatrix3x2fv, &Gl::ProgramUniformMatrix3fv,
         &Gl::ProgramUniformMatrix3x4fv},
        {&Gl::ProgramUniformMatrix4x2fv, &Gl::ProgramUniformMatrix4x3fv,
         &Gl::ProgramUniformMatrix4fv}};
    return (gl.*send[column][row])(p, l, 1, GL_FALSE, as<GLfloat>(value));
}

// Calls visit(index of the component, its offset in the block).
template <class Visitor>
void forEachComponent(const ActiveUniform& uniform, std::size_t componentSize, Visitor visit) {
    const UniformType& type = *uniform.type;
    for (int column = 0; column < type.columns; ++column) {
        for (int row = 0; row < type.rows; ++row) {
            const auto outer = static_cast<std::size_t>(uniform.rowMajor ? row : column);
            const auto inner = static_cast<std::size_t>(uniform.rowMajor ? column : row);
            // Vectors have a stride of 0 and one column.
            visit(column * type.rows + row,
                  uniform.offset + (type.columns > 1
                                        ? outer * uniform.matrixStride + inner * componentSize
                                        : static_cast<std::size_t>(row) * componentSize));
        }
    }
}

} // namespace

void sendUniform(const GlContext& context, unsigned program, int location,
                 const UniformValue& value) {
    if (value.type().columns > 1)
        sendMatrix(context.gl(), program, location, value);
    else
        sendVector(context.gl(), program, location, value);
}

UniformValue fetchUniform(const GlContext& context, unsigned program,
                          const ActiveUniform& uniform) {
    const auto& gl = context.gl();
    UniformValue value(*uniform.type);
    const auto size = static_cast<GLsizei>(UniformValue::kSize);
    switch (uniform.type->kind) {
    case UniformKind::float32:
        gl.GetnUniformfv(program, uniform.location, size, reinterpret_cast<GLfloat*>(value.data()));
        break;
    case UniformKind::float64:
        gl.GetnUniformdv(program, uniform.location, size,
                         reinterpret_cast<GLdouble*>(value.data()));
        break;
    case UniformKind::uint32:
        gl.GetnUniformuiv(program, uniform.location, size, reinterpret_cast<GLuint*>(value.data()));
        break;
    default:
        gl.GetnUniformiv(program, uniform.location, size, reinterpret_cast<GLint*>(value.data()));
        break;
    }
    return value;
}

void writeToBlock(UniformBlock& block, const ActiveUniform& uniform, const UniformValue& value) {
    const std::size_t size = value.componentSize();
    forEachComponent(uniform, size, [&](int index, std::size_t offset) {
        block.write(offset, value.data() + static_cast<std::size_t>(index) * size, size);
    });
}

UniformValue readFromBlock(const UniformBlock& block, const ActiveUniform& uniform) {
    UniformValue value(*uniform.type);
    const std::size_t size = value.componentSize();
    forEachComponent(uniform, size, [&](int index, std::size_t offset) {
        std::memcpy(value.data() + static_cast<std::size_t>(index) * size, block.bytes() + offset,
                    size);
    });
    return value;
}

} // namespace terrane
