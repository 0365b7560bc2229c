// SPDX-License-Identifier: BSD-3-Clause
#include "render/uniform_type.h"

#include <glad/gl.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace terrane {

namespace {

using Kind = UniformKind;

// OpenGL 4.5 core, table 7.3.
constexpr std::array kTypes{
    UniformType{"float", GL_FLOAT, Kind::float32, 1, 1},
    UniformType{"vec2", GL_FLOAT_VEC2, Kind::float32, 1, 2},
    UniformType{"vec3", GL_FLOAT_VEC3, Kind::float32, 1, 3},
    UniformType{"vec4", GL_FLOAT_VEC4, Kind::float32, 1, 4},
    UniformType{"double", GL_DOUBLE, Kind::float64, 1, 1},
    UniformType{"dvec2", GL_DOUBLE_VEC2, Kind::float64, 1, 2},
    UniformType{"dvec3", GL_DOUBLE_VEC3, Kind::float64, 1, 3},
    UniformType{"dvec4", GL_DOUBLE_VEC4, Kind::float64, 1, 4},
    UniformType{"int", GL_INT, Kind::int32, 1, 1},
    UniformType{"ivec2", GL_INT_VEC2, Kind::int32, 1, 2},
    UniformType{"ivec3", GL_INT_VEC3, Kind::int32, 1, 3},
    UniformType{"ivec4", GL_INT_VEC4, Kind::int32, 1, 4},
    UniformType{"uint", GL_UNSIGNED_INT, Kind::uint32, 1, 1},
    UniformType{"uvec2", GL_UNSIGNED_INT_VEC2, Kind::uint32, 1, 2},
    UniformType{"uvec3", GL_UNSIGNED_INT_VEC3, Kind::uint32, 1, 3},
    UniformType{"uvec4", GL_UNSIGNED_INT_VEC4, Kind::uint32, 1, 4},
    UniformType{"bool", GL_BOOL, Kind::boolean, 1, 1},
    UniformType{"bvec2", GL_BOOL_VEC2, Kind::boolean, 1, 2},
    UniformType{"bvec3", GL_BOOL_VEC3, Kind::boolean, 1, 3},
    UniformType{"bvec4", GL_BOOL_VEC4, Kind::boolean, 1, 4},
    UniformType{"mat2", GL_FLOAT_MAT2, Kind::float32, 2, 2},
    UniformType{"mat3", GL_FLOAT_MAT3, Kind::float32, 3, 3},
    UniformType{"mat4", GL_FLOAT_MAT4, Kind::float32, 4, 4},
    UniformType{"mat2x3", GL_FLOAT_MAT2x3, Kind::float32, 2, 3},
    UniformType{"mat2x4", GL_FLOAT_MAT2x4, Kind::float32, 2, 4},
    UniformType{"mat3x2", GL_FLOAT_MAT3x2, Kind::float32, 3, 2},
    UniformType{"mat3x4", GL_FLOAT_MAT3x4, Kind::float32, 3, 4},
    UniformType{"mat4x2", GL_FLOAT_MAT4x2, Kind::float32, 4, 2},
    UniformType{"mat4x3", GL_FLOAT_MAT4x3, Kind::float32, 4, 3},
    UniformType{"dmat2", GL_DOUBLE_MAT2, Kind::float64, 2, 2},
    UniformType{"dmat3", GL_DOUBLE_MAT3, Kind::float64, 3, 3},
    UniformType{"dmat4", GL_DOUBLE_MAT4, Kind::float64, 4, 4},
    UniformType{"dmat2x3", GL_DOUBLE_MAT2x3, Kind::float64, 2, 3},
    UniformType{"dmat2x4", GL_DOUBLE_MAT2x4, Kind::float64, 2, 4},
    UniformType{"dmat3x2", GL_DOUBLE_MAT3x2, Kind::float64, 3, 2},
    UniformType{"dmat3x4", GL_DOUBLE_MAT3x4, Kind::float64, 3, 4},
    UniformType{"dmat4x2", GL_DOUBLE_MAT4x2, Kind::float64, 4, 2},
    UniformType{"dmat4x3", GL_DOUBLE_MAT4x3, Kind::float64, 4, 3},
    UniformType{"sampler1D", GL_SAMPLER_1D, Kind::sampler, 1, 1},
    UniformType{"sampler2D", GL_SAMPLER_2D, Kind::sampler, 1, 1},
    UniformType{"sampler3D", GL_SAMPLER_3D, Kind::sampler, 1, 1},
    UniformType{"samplerCube", GL_SAMPLER_CUBE, Kind::sampler, 1, 1},
    UniformType{"sampler1DShadow", GL_SAMPLER_1D_SHADOW, Kind::sampler, 1, 1},
    UniformType{"sampler2DShadow", GL_SAMPLER_2D_SHADOW, Kind::sampler, 1, 1},
    UniformType{"sampler1DArray", GL_SAMPLER_1D_ARRAY, Kind::sampler, 1, 1},
    UniformType{"sampler2DArray", GL_SAMPLER_2D_ARRAY, Kind::sampler, 1, 1},
    UniformType{"samplerCubeArray", GL_SAMPLER_CUBE_MAP_ARRAY, Kind::sampler, 1, 1},
    UniformType{"sampler1DArrayShadow", GL_SAMPLER_1D_ARRAY_SHADOW, Kind::sampler, 1, 1},
    UniformType{"sampler2DArrayShadow", GL_SAMPLER_2D_ARRAY_SHADOW, Kind::sampler, 1, 1},
    UniformType{"sampler2DMS", GL_SAMPLER_2D_MULTISAMPLE, Kind::sampler, 1, 1},
    UniformType{"sampler2DMSArray", GL_SAMPLER_2D_MULTISAMPLE_ARRAY, Kind::sampler, 1, 1},
    UniformType{"samplerCubeShadow", GL_SAMPLER_CUBE_SHADOW, Kind::sampler, 1, 1},
    UniformType{"samplerCubeArrayShadow", GL_SAMPLER_CUBE_MAP_ARRAY_SHADOW, Kind::sampler, 1, 1},
    UniformType{"samplerBuffer", GL_SAMPLER_BUFFER, Kind::sampler, 1, 1},
    UniformType{"sampler2DRect", GL_SAMPLER_2D_RECT, Kind::sampler, 1, 1},
    UniformType{"sampler2DRectShadow", GL_SAMPLER_2D_RECT_SHADOW, Kind::sampler, 1, 1},
    UniformType{"isampler1D", GL_INT_SAMPLER_1D, Kind::sampler, 1, 1},
    UniformType{"isampler2D", GL_INT_SAMPLER_2D, Kind::sampler, 1, 1},
    UniformType{"isampler3D", GL_INT_SAMPLER_3D, Kind::sampler, 1, 1},
    UniformType{"isamplerCube", GL_INT_SAMPLER_CUBE, Kind::sampler, 1, 1},
    UniformType{"isampler1DArray", GL_INT_SAMPLER_1D_ARRAY, Kind::sampler, 1, 1},
    UniformType{"isampler2DArray", GL_INT_SAMPLER_2D_ARRAY, Kind::sampler, 1, 1},
    UniformType{"isamplerCubeArray", GL_INT_SAMPLER_CUBE_MAP_ARRAY, Kind::sampler, 1, 1},
    UniformType{"isampler2DMS", GL_INT_SAMPLER_2D_MULTISAMPLE, Kind::sampler, 1, 1},
    UniformType{"isampler2DMSArray", GL_INT_SAMPLER_2D_MULTISAMPLE_ARRAY, Kind::sampler, 1, 1},
    UniformType{"isamplerBuffer", GL_INT_SAMPLER_BUFFER, Kind::sampler, 1, 1},
    UniformType{"isampler2DRect", GL_INT_SAMPLER_2D_RECT, Kind::sampler, 1, 1},
    UniformType{"usampler1D", GL_UNSIGNED_INT_SAMPLER_1D, Kind::sampler, 1, 1},
    UniformType{"usampler2D", GL_UNSIGNED_INT_SAMPLER_2D, Kind::sampler, 1, 1},
    UniformType{"usampler3D", GL_UNSIGNED_INT_SAMPLER_3D, Kind::sampler, 1, 1},
    UniformType{"usamplerCube", GL_UNSIGNED_INT_SAMPLER_CUBE, Kind::sampler, 1, 1},
    UniformType{"usampler1DArray", GL_UNSIGNED_INT_SAMPLER_1D_ARRAY, Kind::sampler, 1, 1},
    UniformType{"usampler2DArray", GL_UNSIGNED_INT_SAMPLER_2D_ARRAY, Kind::sampler, 1, 1},
    UniformType{"usamplerCubeArray", GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY, Kind::sampler, 1, 1},
    UniformType{"usampler2DMS", GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE, Kind::sampler, 1, 1},
    UniformType{"usampler2DMSArray", GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE_ARRAY, Kind::sampler, 1,
                1},
    UniformType{"usamplerBuffer", GL_UNSIGNED_INT_SAMPLER_BUFFER, Kind::sampler, 1, 1},
    UniformType{"usampler2DRect", GL_UNSIGNED_INT_SAMPLER_2D_RECT, Kind::sampler, 1, 1},
};

constexpr UniformType kUnknown{"unknown type", 0, Kind::none, 0, 0};

template <class Scalar>
void store(std::byte* target, int index, Scalar value) {
    std::memcpy(target + index * sizeof(Scalar), &value, sizeof(Scalar));
}

template <class Scalar>
Scalar fetch(const std::byte* source, int index) {
    Scalar value;
    std::memcpy(&value, source + index * sizeof(Scalar), sizeof(Scalar));
    return value;
}

bool isReal(Kind kind) {
    return kind == Kind::float32 || kind == Kind::float64;
}

} // namespace

const UniformType& uniformType(unsigned code) {
    const auto found = std::find_if(kTypes.begin(), kTypes.end(),
                                    [&](const UniformType& type) { return type.code == code; });
    return found == kTypes.end() ? kUnknown : *found;
}

const UniformType* findUniformType(std::string_view name) {
    const auto found = std::find_if(kTypes.begin(), kTypes.end(),
                                    [&](const UniformType& type) { return type.name == name; });
    return found == kTypes.end() ? nullptr : &*found;
}

const UniformType* findUniformType(UniformKind kind, int columns, int rows) {
    if (kind == Kind::sampler || kind == Kind::image) return nullptr;
    const auto found = std::find_if(kTypes.begin(), kTypes.end(), [&](const UniformType& type) {
        return type.kind == kind && type.columns == columns && type.rows == rows;
    });
    return found == kTypes.end() ? nullptr : &*found;
}

double UniformValue::component(int index) const {
    switch (type_->kind) {
    case Kind::float32:
        return fetch<float>(data(), index);
    case Kind::float64:
        return fetch<double>(data(), index);
    case Kind::int32:
        return fetch<std::int32_t>(data(), index);
    case Kind::uint32:
    case Kind::boolean:
        return fetch<std::uint32_t>(data(), index);
    default:
        return 0;
    }
}

namespace {

// Conversions of what does not fit are undefined in C++; such values stop at the type's end.
template <class Integer>
Integer clampedTo(double value) {
    const double low = std::numeric_limits<Integer>::min();
    const double high = std::numeric_limits<Integer>::max();
    return static_cast<Integer>(value >= low ? std::min(value, high) : low);
}

} // namespace

void UniformValue::setComponent(int index, double value) {
    switch (type_->kind) {
    case Kind::float32:
        return store(data(), index, static_cast<float>(value));
    case Kind::float64:
        return store(data(), index, value);
    case Kind::int32:
        return store(data(), index, clampedTo<std::int32_t>(value));
    case Kind::uint32:
        return store(data(), index, clampedTo<std::uint32_t>(value));
    case Kind::boolean:
        return store(data(), index, std::uint32_t{value != 0});
    default:
        return;
    }
}

bool UniformValue::operator==(const UniformValue& other) const {
    return *type_ == *other.type_ && std::memcmp(data(), other.data(), size()) == 0;
}

bool assignComponents(const UniformComponents& from, UniformValue& value) {
    const UniformType& type = value.type();
    const bool sameShape = type.columns == from.columns && type.rows == from.rows;
    if (!sameShape || (type.kind != from.kind && !(isReal(type.kind) && isReal(from.kind))))
        return false;
    for (int i = 0; i < type.components(); ++i) {
        if (type.kind == Kind::float32)
            store(value.data(), i, static_cast<float>(from.reals[i]));
        else if (type.kind == Kind::float64)
            store(value.data(), i, from.reals[i]);
        else
            store(value.data(), i, from.integers[i]);
    }
    return true;
}

} // namespace terrane
