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

/// Dimensions of the GL calls: 1D arrays are two-dimensional to OpenGL, cubes three-dimensional.
int dimensions(T target) {
    switch (target) {
    case T::texture1D:
    case T::buffer:
        return 1;
    case T::texture1DArray:
    case T::texture2D:
    case T::rectangle:
    case T::multisample2D:
        return 2;
    default:
        return 3;
    }
}

/// OpenGL's view of a region: the layers of 1D arrays are its rows.
TextureRegion toGl(T target, TextureRegion region) {
    if (target == T::texture1DArray) {
        region.y = region.z;
        region.height = region.depth;
        region.z = 0;
        region.depth = 1;
    }
    return region;
}

bool isMultisample(T target) {
    return target == T::multisample2D || target == T::multisample2DArray;
}

struct TextureCalls {
    const GladGLContext& gl;
    unsigned name;

    void integer(unsigned parameter, int value) const {
        gl.TextureParameteri(name, parameter, value);
    }
    void real(unsigned parameter, float value) const {
        gl.TextureParameterf(name, parameter, value);
    }
    void reals(unsigned parameter, const float* values) const {
        gl.TextureParameterfv(name, parameter, values);
    }
    void integers(unsigned parameter, const int* values) const {
        gl.TextureParameterIiv(name, parameter, values);
    }
    void unsignedIntegers(unsigned parameter, const unsigned* values) const {
        gl.TextureParameterIuiv(name, parameter, values);
    }
};

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

std::size_t pixelCount(const TextureRegion& region) {
    return std::size_t(region.width) * std::size_t(region.height) * std::size_t(region.depth);
}

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
    const bool isFlat = dimensions(d.target) == 1 || d.target == T::texture1DArray;
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
    const TextureCalls calls{gl, name_};
    const bool isRectangle = description_.target == T::rectangle;
    sendSampling(*context_, s, {.integer = format_->integer(), .rectangle = isRectangle}, calls);
    if (!isRectangle) {
        calls.integer(GL_TEXTURE_BASE_LEVEL, std::max(0, s.minLevel));
        calls.integer(GL_TEXTURE_MAX_LEVEL, std::max(0, s.maxLevel));
    }
    GLint swizzle[4];
    std::transform(s.swizzle.begin(), s.swizzle.end(), swizzle, [](auto c) { return GLint(c); });
    gl.TextureParameteriv(name_, GL_TEXTURE_SWIZZLE_RGBA, swizzle);
}

void Texture::upload(TransferLayout layout, std::span<const std::byte> pixels) {
    upload(region(), layout, pixels);
    generateMipmaps();
}

void Texture::upload(const TextureRegion& region, TransferLayout layout,
                     std::span<const std::byte> pixels) {
    assert(isSampled() && "Texture::upload(): multisample and buffer textures have none");
    assert(pixels.size() >= pixelCount(region) * layout.pixelSize() &&
           "Texture::upload(): too few pixels");
    const auto& gl = context_->gl();
    const auto r = toGl(description_.target, region);
    const auto format = unsigned(layout.format);
    const auto type = unsigned(layout.type);
    switch (dimensions(description_.target)) {
    case 1:
        gl.TextureSubImage1D(name_, r.level, r.x, r.width, format, type, pixels.data());
        break;
    case 2:
        gl.TextureSubImage2D(name_, r.level, r.x, r.y, r.width, r.height, format, type,
                             pixels.data());
        break;
    default:
        gl.TextureSubImage3D(name_, r.level, r.x, r.y, r.z, r.width, r.height, r.depth, format,
                             type, pixels.data());
        break;
    }
}

void Texture::uploadCompressed(const TextureRegion& region, std::span<const std::byte> blocks) {
    assert(format_->compressed && "Texture::uploadCompressed(): the texture is not compressed");
    const std::size_t expected = std::size_t((region.width + 3) / 4) *
                                 std::size_t((region.height + 3) / 4) * std::size_t(region.depth) *
                                 std::size_t(format_->bytes);
    assert(blocks.size() >= expected && "Texture::uploadCompressed(): too few blocks");
    const auto& gl = context_->gl();
    if (dimensions(description_.target) == 2) {
        gl.CompressedTextureSubImage2D(name_, region.level, region.x, region.y, region.width,
                                       region.height, format_->storage, GLsizei(expected),
                                       blocks.data());
    } else {
        gl.CompressedTextureSubImage3D(name_, region.level, region.x, region.y, region.z,
                                       region.width, region.height, region.depth, format_->storage,
                                       GLsizei(expected), blocks.data());
    }
}

void Texture::clear() {
    for (int level = 0; level < levels(); ++level) {
        if (format_->compressed) {
            const auto r = region(level);
            const std::size_t size = std::size_t((r.width + 3) / 4) *
                                     std::size_t((r.height + 3) / 4) * std::size_t(r.depth) *
                                     std::size_t(format_->bytes);
            uploadCompressed(r, std::vector<std::byte>(size));
        } else {
            context_->gl().ClearTexImage(name_, level, unsigned(format_->transfer.format),
                                         unsigned(format_->transfer.type), nullptr);
        }
    }
}

std::vector<std::byte> Texture::download(const TextureRegion& region, TransferLayout layout) const {
    assert(isSampled() && "Texture::download(): multisample and buffer textures have none");
    std::vector<std::byte> pixels(pixelCount(region) * layout.pixelSize());
    const auto r = toGl(description_.target, region);
    context_->gl().GetTextureSubImage(name_, r.level, r.x, r.y, r.z, r.width, r.height, r.depth,
                                      unsigned(layout.format), unsigned(layout.type),
                                      GLsizei(pixels.size()), pixels.data());
    return pixels;
}

std::vector<std::byte> Texture::download(const TextureRegion& region) const {
    return download(region, format_->transfer);
}

void Texture::generateMipmaps() {
    if (levels() > 1) context_->gl().GenerateTextureMipmap(name_);
}

void Texture::generateMipmaps(int layer) {
    assert(description_.target == T::texture2DArray && "Texture::generateMipmaps(): no 2D array");
    if (levels() == 1) return;
    const auto& gl = context_->gl();
    GLuint view = 0; // OpenGL generates levels for whole textures only: this one is the layer
    gl.GenTextures(1, &view);
    gl.TextureView(view, GL_TEXTURE_2D, name_, format_->storage, 0, GLuint(levels()), GLuint(layer),
                   1);
    gl.GenerateTextureMipmap(view);
    gl.DeleteTextures(1, &view);
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
