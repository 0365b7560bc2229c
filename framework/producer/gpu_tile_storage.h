// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/tile_storage.h"
#include "render/framebuffer.h"
#include "render/texture.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace terrane {

class ElevationReadback;

/// Raster tiles on the GPU: each slot is a layer of a 2D array texture. As many textures as the
/// limit on layers asks for, all full but the last (terrain reference 1.1).
class GpuTileStorage : public TileStorage {
public:
    struct Description {
        int tileSize = 1; ///< edge in pixels, borders included
        int tiles = 1;
        InternalFormat format = InternalFormat::rgba8;
        TransferLayout transfer; ///< of uploads that don't say theirs
        SamplingParameters sampling;
        bool tileMap = false;
    };

    class Slot : public TileSlot {
    public:
        Slot(int index, std::shared_ptr<Texture> texture, int layer)
            : TileSlot(index)
            , texture_(std::move(texture))
            , layer_(layer) {}

        const std::shared_ptr<Texture>& texture() const { return texture_; }
        int layer() const { return layer_; }

        /// Takes the tile from the lower left corner of the framebuffer's read buffer; formats are
        /// converted. The mipmaps follow.
        void copyFrom(const Framebuffer& framebuffer);
        /// Takes the tile from memory, rows from the bottom, tightly packed. The mipmaps follow.
        void upload(TransferLayout layout, std::span<const std::byte> pixels);
        /// To be called after the layer was changed in another way.
        void updateMipmaps();

    private:
        TextureRegion region() const;

        std::shared_ptr<Texture> texture_;
        int layer_;
    };

    /// Why such a storage can't be had, for people to read; empty when it can.
    static std::string problem(const GlContext& context, const Description& description,
                               int maxLayers);
    /// @param maxLayers layers of one texture; the context's limit, or less
    GpuTileStorage(const GlContext& context, const Description& description, int maxLayers);

    const Description& description() const { return description_; }
    const InternalFormatInfo& format() const { return formatInfo(description_.format); }
    const std::vector<std::shared_ptr<Texture>>& textures() const { return textures_; }
    const GlContext& context() const { return context_; }

    /// For `textureQuadtree`: which slots hold which quads around the camera, 4096 x 8 texels of
    /// RG8, one row for each producer of the cache (terrain reference 3.6). Null without `tileMap`.
    const std::shared_ptr<Texture>& tileMap() const { return tileMap_; }

    /// Shared by all who read elevations of these tiles back; see ElevationReadback::of.
    std::weak_ptr<ElevationReadback> elevationReadback;

    static constexpr int kMapWidth = 4096;
    static constexpr int kMapHeight = 8;

private:
    const GlContext& context_;
    const Description description_;
    std::vector<std::shared_ptr<Texture>> textures_;
    std::shared_ptr<Texture> tileMap_;
};

} // namespace terrane
