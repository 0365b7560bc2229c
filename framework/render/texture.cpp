// SPDX-License-Identifier: BSD-3-Clause
#include "render/texture.h"

#include "render/sampling_transfer.h"
#include "render/state_tracker.h"

#include <glad/gl.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

namespace terrane {

namespace {

using T = TextureTarget;

int fullLevels(const TextureDescription& d) {
    int size = d.width;
    if (d.target != T::texture1D && d.target != T::texture1DArray) {
        size = std::max(size, d.height);
    }
    if (d.target == T::texture3D) size = std::max(size, d.depth);
    return std::bit_width(unsigned(size));
}

int levelSize(int size, int level) {
    return std::max(1, size >> level);
}

int integerParameter(const GlContext& context, unsigned parameter) {
    GLint value = 0;
    context.gl().GetIntegerv(parameter, &value);
    return value;
}

bool isMultisample(T target) {
    return target == T::multisample2D || target == T::multisample2DArray;
}

/// Silences debug output, and tells afterwards what went wrong: when memory runs out, whoever asked
/// for it says so, with a place.
class QuietAllocation {
public:
    explicit QuietAllocation(const GlContext& context)
        : context_(context)
        , loud_(context.gl().IsEnabled(GL_DEBUG_OUTPUT) == GL_TRUE) {
        if (!loud_) return;
        context_.gl().Disable(GL_DEBUG_OUTPUT);
        while (context_.gl().GetError() != GL_NO_ERROR) {
            // earlier ones, which have been told
        }
    }
    QuietAllocation(const QuietAllocation&) = delete;
    QuietAllocation& operator=(const QuietAllocation&) = delete;
    ~QuietAllocation() {
        if (!loud_) return;
        for (GLenum error = context_.gl().GetError(); error != GL_NO_ERROR;
             error = context_.gl().GetError()) {
            if (error != GL_OUT_OF_MEMORY) {
                context_.diagnostics().error(
                    "gl-error", {}, "OpenGL error " + std::to_string(error) + " for a texture");
            }
        }
        context_.gl().Enable(GL_DEBUG_OUTPUT);
    }

private:
    const GlContext& context_;
    bool loud_;
};

} // namespace

std::string Texture::problem(const GlContext& context, const TextureDescription& d) {
    if (d.width < 1 || d.height < 1 || d.depth < 1 || d.layers < 1) {
        return "the size of a texture must be at least 1";
    }
    const unsigned limitName = d.target == T::texture3D ? GL_MAX_3D_TEXTURE_SIZE
                               : d.target == T::cube || d.target == T::cubeArray
                                   ? GL_MAX_CUBE_MAP_TEXTURE_SIZE
                               : d.target == T::rectangle ? GL_MAX_RECTANGLE_TEXTURE_SIZE
                               : d.target == T::buffer    ? GL_MAX_TEXTURE_BUFFER_SIZE
                                                          : GL_MAX_TEXTURE_SIZE;
    const int limit = integerParameter(context, limitName);
    if (std::max({d.width, d.height, d.depth}) > limit) {
        return "the texture is larger than the " + std::to_string(limit) + " pixels of the driver";
    }
    const int layers = d.target == T::cubeArray ? 6 * d.layers : d.layers;
    if (layers > context.maxArrayLayers()) {
        return "the texture has more layers than the " + std::to_string(context.maxArrayLayers()) +
               " of the driver";
    }
    const bool isCube = d.target == T::cube || d.target == T::cubeArray;
    if (isCube && d.width != d.height) return "the faces of a cube map must be square";
    const auto& format = formatInfo(d.format);
    const bool isFlat =
        d.target == T::texture1D || d.target == T::texture1DArray || d.target == T::buffer;
    if (format.compressed && (isFlat || d.target == T::rectangle)) {
        return "1D and rectangle textures can't be compressed";
    }
    if (d.target == T::texture3D && (format.compressed || format.hasDepth())) {
        return "3D textures can't be compressed nor hold depth";
    }
    if (isMultisample(d.target) && format.compressed) {
        return "multisample textures can't be compressed";
    }
    const unsigned samplesName = format.integer()    ? GL_MAX_INTEGER_SAMPLES
                                 : format.hasDepth() ? GL_MAX_DEPTH_TEXTURE_SAMPLES
                                                     : GL_MAX_COLOR_TEXTURE_SAMPLES;
    const int mostSamples = isMultisample(d.target) ? integerParameter(context, samplesName) : 1;
    if (d.samples < 1 || d.samples > mostSamples) {
        return "the texture has " + std::to_string(d.samples) + " samples a pixel, not 1 to " +
               std::to_string(mostSamples);
    }
    const bool hasLevels =
        d.target != T::rectangle && d.target != T::buffer && !isMultisample(d.target);
    if (d.levels > (hasLevels ? fullLevels(d) : 1)) {
        return "the texture has more levels than its size allows";
    }
    return {};
}

Texture::Texture(const GlContext& context, const TextureDescription& description,
                 const SamplingParameters& sampling)
    : context_(&context)
    , description_(description)
    , sampling_(sampling)
    , format_(&formatInfo(description.format))
    , fullChain_(description.levels == 0) {
    create();
}

Texture::Texture(const GlContext& context, InternalFormat format,
                 std::shared_ptr<const Buffer> buffer)
    : context_(&context)
    , format_(&formatInfo(format))
    , buffer_(std::move(buffer)) {
    const auto pixels = int(buffer_->size() / std::size_t(format_->bytes));
    description_ = {.target = T::buffer, .format = format, .width = std::max(1, pixels)};
    create();
}

Texture::~Texture() {
    destroy();
}

Texture::Texture(Texture&& other) noexcept
    : Resource()
    , context_(other.context_)
    , description_(other.description_)
    , sampling_(other.sampling_)
    , format_(other.format_)
    , buffer_(std::move(other.buffer_))
    , name_(std::exchange(other.name_, 0))
    , serial_(other.serial_)
    , allocated_(other.allocated_)
    , fullChain_(other.fullChain_) {}

Texture& Texture::operator=(Texture&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(description_, other.description_);
    std::swap(sampling_, other.sampling_);
    std::swap(format_, other.format_);
    std::swap(buffer_, other.buffer_);
    std::swap(name_, other.name_);
    std::swap(serial_, other.serial_);
    std::swap(allocated_, other.allocated_);
    std::swap(fullChain_, other.fullChain_);
    return *this;
}

void Texture::create() {
    assert(context_->isCurrent() && "Texture: its context is not current");
    assert(problem(*context_, description_).empty() && "Texture: impossible description");
    auto& d = description_;
    if (fullChain_) {
        const bool chain = sampling_.mipmapped() && d.target != T::rectangle && isSampled();
        d.levels = chain ? fullLevels(d) : 1;
    }
    d.levels = std::max(1, d.levels);
    const auto& gl = context_->gl();
    gl.CreateTextures(unsigned(d.target), 1, &name_);
    context_->countObject(1);
    serial_ = context_->nextSerial();
    {
        const QuietAllocation quiet(*context_);
        allocate();
    }
    GLint immutable = GLint(d.target == T::buffer);
    if (!immutable) gl.GetTextureParameteriv(name_, GL_TEXTURE_IMMUTABLE_FORMAT, &immutable);
    allocated_ = immutable != 0;
    if (allocated_) applySampling();
}

void Texture::allocate() {
    const auto& d = description_;
    const auto& gl = context_->gl();
    switch (d.target) {
    case T::buffer:
        gl.TextureBuffer(name_, format_->storage, buffer_->name());
        break;
    case T::multisample2D:
        gl.TextureStorage2DMultisample(name_, d.samples, format_->storage, d.width, d.height,
                                       GL_TRUE);
        break;
    case T::multisample2DArray:
        gl.TextureStorage3DMultisample(name_, d.samples, format_->storage, d.width, d.height,
                                       d.layers, GL_TRUE);
        break;
    case T::texture1D:
        gl.TextureStorage1D(name_, d.levels, format_->storage, d.width);
        break;
    case T::texture1DArray:
        gl.TextureStorage2D(name_, d.levels, format_->storage, d.width, d.layers);
        break;
    case T::texture2D:
    case T::rectangle:
    case T::cube:
        gl.TextureStorage2D(name_, d.levels, format_->storage, d.width, d.height);
        break;
    default:
        gl.TextureStorage3D(name_, d.levels, format_->storage, d.width, d.height, zCount());
        break;
    }
}

bool Texture::isSampled() const {
    return description_.target != T::buffer && !isMultisample(description_.target);
}

void Texture::destroy() {
    if (!name_) return;
    assert(context_->isCurrent() && "Texture: its context is not current");
    context_->state().forgetTexture(name_);
    context_->gl().DeleteTextures(1, &name_);
    context_->countObject(-1);
    name_ = 0;
}

int Texture::zCount(int level) const {
    switch (description_.target) {
    case T::texture3D:
        return levelSize(description_.depth, level);
    case T::cube:
        return 6;
    case T::cubeArray:
        return 6 * description_.layers;
    default:
        return description_.layers;
    }
}

TextureRegion Texture::region(int level) const {
    const auto target = description_.target;
    const bool isFlat = target == T::texture1D || target == T::texture1DArray;
    return {.level = level,
            .width = levelSize(description_.width, level),
            .height = isFlat ? 1 : levelSize(description_.height, level),
            .depth = zCount(level)};
}

void Texture::bind(unsigned unit) const {
    context_->state().bindTexture(unit, name_);
}

void Texture::setSampling(const SamplingParameters& sampling) {
    if (sampling == sampling_) return;
    sampling_ = sampling;
    applySampling();
}

void Texture::applySampling() {
    if (!isSampled()) return;
    const auto& gl = context_->gl();
    const auto& s = sampling_;
    const bool isRectangle = description_.target == T::rectangle;
    sendSampling(*context_, s, {.integer = format_->integer(), .rectangle = isRectangle},
                 {name_, gl.TextureParameteri, gl.TextureParameterf, gl.TextureParameterfv,
                  gl.TextureParameterIiv, gl.TextureParameterIuiv});
    if (!isRectangle) limitLevels(*context_, name_, s.minLevel, s.maxLevel);
    GLint swizzle[4];
    std::transform(s.swizzle.begin(), s.swizzle.end(), swizzle, [](auto c) { return GLint(c); });
    gl.TextureParameteriv(name_, GL_TEXTURE_SWIZZLE_RGBA, swizzle);
}

void Texture::resize(int width, int height) {
    assert(!buffer_ && "Texture::resize(): the buffer decides");
    if (width == description_.width && height == description_.height) return;
    destroy();
    description_.width = width;
    description_.height = height;
    create();
}

} // namespace terrane
