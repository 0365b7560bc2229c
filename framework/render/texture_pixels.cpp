// SPDX-License-Identifier: BSD-3-Clause
// The half of Texture that moves pixels.
#include "render/texture.h"

#include "render/sampling_transfer.h"

#include <glad/gl.h>

#include <cassert>

namespace terrane {

namespace {

using T = TextureTarget;

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

std::size_t pixelCount(const TextureRegion& region) {
    return std::size_t(region.width) * std::size_t(region.height) * std::size_t(region.depth);
}

} // namespace

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
    if (levels() == 1) return;
    // OpenGL fills only the levels that are sampled, from the first of these.
    limitLevels(*context_, name_, 0, levels() - 1);
    context_->gl().GenerateTextureMipmap(name_);
    limitLevels(*context_, name_, sampling_.minLevel, sampling_.maxLevel);
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

} // namespace terrane
