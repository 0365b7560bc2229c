// SPDX-License-Identifier: BSD-3-Clause
#include "producer/gpu_tile_storage.h"

#include <algorithm>
#include <cassert>

namespace terrane {

namespace {

TextureDescription arrayOf(const GpuTileStorage::Description& d, int layers) {
    return {.target = TextureTarget::texture2DArray,
            .format = d.format,
            .width = d.tileSize,
            .height = d.tileSize,
            .layers = layers};
}

} // namespace

TextureRegion GpuTileStorage::Slot::region() const {
    return {.z = layer_, .width = texture_->width(), .height = texture_->height()};
}

void GpuTileStorage::Slot::copyFrom(const Framebuffer& framebuffer) {
    framebuffer.copyTo(*texture_, region());
    updateMipmaps();
}

void GpuTileStorage::Slot::upload(TransferLayout layout, std::span<const std::byte> pixels) {
    texture_->upload(region(), layout, pixels);
    updateMipmaps();
}

void GpuTileStorage::Slot::updateMipmaps() {
    texture_->generateMipmaps(layer_);
}

std::string GpuTileStorage::problem(const GlContext& context, const Description& d, int maxLayers) {
    if (d.tileMap && d.tiles > maxLayers)
        return "a tile map needs all tiles in one texture, which holds " +
               std::to_string(maxLayers) + " at most";
    return Texture::problem(context, arrayOf(d, std::min(d.tiles, maxLayers)));
}

GpuTileStorage::GpuTileStorage(const GlContext& context, const Description& description,
                               int maxLayers)
    : TileStorage(description.tileSize)
    , context_(context)
    , description_(description) {
    assert(problem(context, description, maxLayers).empty() && "GpuTileStorage: impossible");
    std::vector<std::unique_ptr<TileSlot>> slots;
    for (int first = 0; first < description.tiles; first += maxLayers) {
        const int layers = std::min(maxLayers, description.tiles - first);
        const auto texture =
            std::make_shared<Texture>(context, arrayOf(description, layers), description.sampling);
        textures_.push_back(texture);
        for (int layer = 0; layer < layers; ++layer)
            slots.push_back(std::make_unique<Slot>(first + layer, texture, layer));
    }
    setSlots(std::move(slots));
    if (!description.tileMap) return;
    const TextureDescription map{
        .format = InternalFormat::rg8, .width = kMapWidth, .height = kMapHeight};
    tileMap_ =
        std::make_shared<Texture>(context, map, SamplingParameters{.mag = MagFilter::nearest});
    tileMap_->clear();
}

} // namespace terrane
