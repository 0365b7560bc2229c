// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What textures and samplers have in common; nobody else includes this.

#include "render/context.h"
#include "render/sampling_parameters.h"

#include <glad/gl.h>

#include <algorithm>
#include <limits>

#include <glm/vec4.hpp>

namespace terrane {

/// What is sampled, as far as it limits how.
struct SampledKind {
    bool integer = false;   ///< OpenGL calls a filtered integer texture incomplete, and so black
    bool rectangle = false; ///< has neither mipmaps nor repetition
};

/// OpenGL's calls for the parameters that textures and samplers share: glTextureParameter* or
/// glSamplerParameter*, which are alike.
struct SamplingCalls {
    unsigned name = 0; ///< of the texture or sampler
    PFNGLTEXTUREPARAMETERIPROC setInteger = nullptr;
    PFNGLTEXTUREPARAMETERFPROC setReal = nullptr;
    PFNGLTEXTUREPARAMETERFVPROC setReals = nullptr;
    PFNGLTEXTUREPARAMETERIIVPROC setIntegers = nullptr;
    PFNGLTEXTUREPARAMETERIUIVPROC setUnsignedIntegers = nullptr;
};

inline void sendSampling(const GlContext& context, const SamplingParameters& s, SampledKind kind,
                         const SamplingCalls& calls) {
    const auto integer = [&](GLenum parameter, GLint value) {
        calls.setInteger(calls.name, parameter, value);
    };
    const auto real = [&](GLenum parameter, GLfloat value) {
        calls.setReal(calls.name, parameter, value);
    };
    MinFilter min = s.min;
    if (kind.rectangle && s.mipmapped()) min = MinFilter::linear;
    if (kind.integer) min = s.mipmapped() ? MinFilter::nearestMipmapNearest : MinFilter::nearest;
    integer(GL_TEXTURE_MIN_FILTER, GLint(min));
    integer(GL_TEXTURE_MAG_FILTER, GLint(kind.integer ? MagFilter::nearest : s.mag));
    const auto wrap = [&](Wrap wanted) {
        const bool repeats = wanted == Wrap::repeat || wanted == Wrap::mirroredRepeat;
        return GLint(kind.rectangle && repeats ? Wrap::clampToEdge : wanted);
    };
    integer(GL_TEXTURE_WRAP_S, wrap(s.wrapS));
    integer(GL_TEXTURE_WRAP_T, wrap(s.wrapT));
    integer(GL_TEXTURE_WRAP_R, wrap(s.wrapR));
    real(GL_TEXTURE_MIN_LOD, s.minLod);
    real(GL_TEXTURE_MAX_LOD, s.maxLod);
    real(GL_TEXTURE_LOD_BIAS, s.bias);
    const auto& gl = context.gl();
    if (gl.ARB_texture_filter_anisotropic || gl.EXT_texture_filter_anisotropic) {
        real(GL_TEXTURE_MAX_ANISOTROPY, std::clamp(s.anisotropy, 1.0F, context.maxAnisotropy()));
    }
    const bool compares = s.compare != CompareFunction::always;
    integer(GL_TEXTURE_COMPARE_MODE, compares ? GL_COMPARE_REF_TO_TEXTURE : GL_NONE);
    if (compares) integer(GL_TEXTURE_COMPARE_FUNC, GLint(s.compare));

    if (s.borderType == BorderType::integer) {
        const GLint colour[4] = {GLint(s.border.r), GLint(s.border.g), GLint(s.border.b),
                                 GLint(s.border.a)};
        calls.setIntegers(calls.name, GL_TEXTURE_BORDER_COLOR, colour);
    } else if (s.borderType == BorderType::unsignedInteger) {
        const GLuint colour[4] = {GLuint(s.border.r), GLuint(s.border.g), GLuint(s.border.b),
                                  GLuint(s.border.a)};
        calls.setUnsignedIntegers(calls.name, GL_TEXTURE_BORDER_COLOR, colour);
    } else {
        const double scale = s.borderType == BorderType::real
                                 ? 1.0
                                 : double(std::numeric_limits<std::int32_t>::max());
        const glm::vec4 colour(s.border / scale);
        calls.setReals(calls.name, GL_TEXTURE_BORDER_COLOR, &colour.x);
    }
}

/// The levels of a texture (not of a rectangle) that are sampled.
inline void limitLevels(const GlContext& context, unsigned texture, int first, int last) {
    const auto& gl = context.gl();
    gl.TextureParameteri(texture, GL_TEXTURE_BASE_LEVEL, std::max(0, first));
    gl.TextureParameteri(texture, GL_TEXTURE_MAX_LEVEL, std::max(0, last));
}

} // namespace terrane
