// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/pipeline_state.h"

#include <array>

#include <glm/vec4.hpp>

namespace terrane {

enum class MinFilter : unsigned {
    nearest = 0x2600,
    linear = 0x2601,
    nearestMipmapNearest = 0x2700,
    linearMipmapNearest,
    nearestMipmapLinear,
    linearMipmapLinear
};
enum class MagFilter : unsigned { nearest = 0x2600, linear = 0x2601 };
enum class Wrap : unsigned {
    clampToEdge = 0x812F,
    clampToBorder = 0x812D,
    repeat = 0x2901,
    mirroredRepeat = 0x8370
};
enum class Swizzle : unsigned { zero = 0, one = 1, red = 0x1903, green, blue, alpha };
/// How the numbers of a border colour are meant.
enum class BorderType {
    normalizedInteger, ///< `INT`: the full range of a signed 32-bit integer stands for -1 to 1
    real,              ///< `FLOAT`
    integer,           ///< `IINT`: as they are, for signed integer textures
    unsignedInteger    ///< `IUNSIGNED_INT`: as they are, for unsigned integer textures
};

/// How a texture is read by shaders: plain data with the defaults of the elements (Ork
/// reference 2.2).
struct SamplingParameters {
    MinFilter min = MinFilter::nearest;
    MagFilter mag = MagFilter::linear; ///< integer textures are always read nearest
    Wrap wrapS = Wrap::clampToEdge;
    Wrap wrapT = Wrap::clampToEdge;
    Wrap wrapR = Wrap::clampToEdge;
    float minLod = -1000;
    float maxLod = 1000;
    float bias = 0;
    int minLevel = 0;
    int maxLevel = 1000;
    float anisotropy = 1; ///< capped by GlContext::maxAnisotropy
    std::array<Swizzle, 4> swizzle{Swizzle::red, Swizzle::green, Swizzle::blue, Swizzle::alpha};
    /// Anything but `always` makes a depth texture compare, for shadow samplers.
    CompareFunction compare = CompareFunction::always;
    BorderType borderType = BorderType::normalizedInteger;
    glm::dvec4 border{0};

    bool mipmapped() const { return min != MinFilter::nearest && min != MinFilter::linear; }
    bool operator==(const SamplingParameters&) const = default;
};

} // namespace terrane
