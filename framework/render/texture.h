// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/buffer.h"
#include "render/context.h"
#include "render/sampling_parameters.h"
#include "render/texture_format.h"
#include "resource/resource.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace terrane {

enum class TextureTarget : unsigned {
    texture1D = 0x0DE0,
    texture1DArray = 0x8C18,
    texture2D = 0x0DE1,
    texture2DArray = 0x8C1A,
    texture3D = 0x806F,
    cube = 0x8513,
    cubeArray = 0x9009,
    rectangle = 0x84F5,
    multisample2D = 0x9100,
    multisample2DArray = 0x9102,
    buffer = 0x8C2A
};

/// What a texture is made of. What a target does not have stays 1.
struct TextureDescription {
    TextureTarget target = TextureTarget::texture2D;
    InternalFormat format = InternalFormat::rgba8;
    int width = 1;
    int height = 1;  ///< of one slice, layer or face; equals width for cubes
    int depth = 1;   ///< slices of a 3D texture
    int layers = 1;  ///< of arrays; whole cubes of a cube array
    int levels = 0;  ///< 0: the full chain if the sampling is mipmapped, else 1
    int samples = 1; ///< a pixel, of multisample textures; drivers may take more

    bool operator==(const TextureDescription&) const = default;
};

/// A box of pixels of one level. z counts slices, layers or faces (of a cube array: 6 * cube +
/// face; faces are +X -X +Y -Y +Z -Z), also for 1D arrays, whose y is 0.
struct TextureRegion {
    int level = 0;
    int x = 0, y = 0, z = 0;
    int width = 1, height = 1, depth = 1;
};

/// An immutable texture with its sampling parameters. The GL name is a private affair of this
/// object: resize() replaces it, so keep the object, not the name. Move-only; GL thread only, with
/// its context current.
///
///     Texture noise(context, {.format = InternalFormat::r8, .width = 64, .height = 64},
///                   {.wrapS = Wrap::repeat, .wrapT = Wrap::repeat});
///     noise.upload({TransferFormat::red, TransferType::u8}, pixels);
///     noise.bind(0);
///
/// Multisample textures are drawn into, and read by shaders sample by sample; they have neither
/// levels nor sampling parameters, and can't be uploaded nor downloaded. Buffer textures are a
/// view of a Buffer as a line of pixels, without levels and sampling parameters either.
class Texture : public Resource {
public:
    /// Contents are undefined until the first upload. `description` must be without problem().
    Texture(const GlContext& context, const TextureDescription& description,
            const SamplingParameters& sampling = {});
    /// A buffer texture: the pixels that a buffer holds now. It keeps the buffer alive.
    Texture(const GlContext& context, InternalFormat format, std::shared_ptr<const Buffer> buffer);
    ~Texture() override;
    Texture(Texture&& other) noexcept;
    Texture& operator=(Texture&& other) noexcept;

    /// What makes a description impossible (sizes against the limits of the context, a cube that is
    /// not square...), for people to read; empty when it is fine.
    static std::string problem(const GlContext& context, const TextureDescription& description);

    const TextureDescription& description() const { return description_; } ///< with levels resolved
    const SamplingParameters& sampling() const { return sampling_; }
    const InternalFormatInfo& format() const { return *format_; }
    int width() const { return description_.width; }
    int height() const { return description_.height; }
    int levels() const { return description_.levels; }
    /// Slices, layers or faces of a level: the extent of TextureRegion::z.
    int zCount(int level = 0) const;
    /// All pixels of a level.
    TextureRegion region(int level = 0) const;
    const GlContext& context() const { return *context_; }

    /// Whether shaders filter and wrap it: not multisample and buffer textures.
    bool isSampled() const;
    /// False when the driver had no memory for it; it can then only be destroyed.
    bool allocated() const { return allocated_; }
    unsigned name() const { return name_; }
    /// Changes when the storage does: tells whether what was attached is still the same.
    std::uint64_t serial() const { return serial_; }

    void bind(unsigned unit) const;
    void setSampling(const SamplingParameters& sampling);

    /// Writes all of level 0, then generates the mipmaps if the sampling uses them. `pixels` are
    /// tightly packed, first row at the bottom, slices one after the other.
    void upload(TransferLayout layout, std::span<const std::byte> pixels);
    /// Writes a part, without generating mipmaps.
    void upload(const TextureRegion& region, TransferLayout layout,
                std::span<const std::byte> pixels);
    /// Writes blocks that are compressed already, in the format of the texture.
    void uploadCompressed(const TextureRegion& region, std::span<const std::byte> blocks);
    /// Zeroes all levels.
    void clear();

    /// Reads back in `format().transfer` or another layout; of compressed textures only whole
    /// blocks. Waits for the GPU.
    std::vector<std::byte> download(const TextureRegion& region, TransferLayout layout) const;
    std::vector<std::byte> download(const TextureRegion& region) const;

    /// Fills the levels above 0 from level 0. Nothing happens without such levels.
    void generateMipmaps();
    /// The same for one layer of a 2D array.
    void generateMipmaps(int layer);

    /// New storage of another size if it differs; the contents are lost.
    void resize(int width, int height);

private:
    void create();
    void allocate();
    void destroy();
    void applySampling();

    const GlContext* context_;
    TextureDescription description_;
    SamplingParameters sampling_;
    const InternalFormatInfo* format_;
    std::shared_ptr<const Buffer> buffer_; ///< of buffer textures
    unsigned name_ = 0;
    std::uint64_t serial_ = 0;
    bool allocated_ = false;
    bool fullChain_ = false; ///< levels follow the size when resized
};

} // namespace terrane
