// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/elevation_at.h"

#include "producer/gpu_tile_storage.h"
#include "terrain/tile_sampler.h"
#include "terrain/tile_sampler_z.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <glm/common.hpp>

namespace terrane {

namespace {

/// The finest tile with data, and where the point is in its quad.
struct Found {
    const Tile* tile = nullptr;
    glm::dvec2 inQuad{0};
};

// Coarser levels may have been evicted while finer ones are there.
Found finestTile(const TerrainNode& terrain, const TileProducer& producer,
                 const glm::dvec2& inRoot) {
    for (int level = terrain.parameters().maxLevel; level >= 0; --level) {
        const glm::dvec2 scaled = inRoot * std::exp2(level);
        const glm::dvec2 quad = glm::min(glm::floor(scaled), glm::dvec2(std::exp2(level) - 1));
        const TileId id{level, static_cast<int>(quad.x), static_cast<int>(quad.y)};
        if (const Tile* tile = producer.findTile(id, true, true)) return {tile, scaled - quad};
    }
    return {};
}

// Two by two texels, or fewer at an edge, of which the last are then repeated.
std::array<double, 4> texelsAround(const GpuTileStorage::Slot& slot, const glm::ivec2& corner) {
    const Texture& texture = *slot.texture();
    const glm::ivec2 size = glm::min(glm::ivec2(2), glm::ivec2(texture.width()) - corner);
    const auto bytes = texture.download(
        {.x = corner.x, .y = corner.y, .z = slot.layer(), .width = size.x, .height = size.y},
        {TransferFormat::rgb, TransferType::f32});
    std::array<float, 12> texels{};
    std::memcpy(texels.data(), bytes.data(), std::min(bytes.size(), sizeof texels));
    const auto z = [&](int x, int y) -> double {
        const int pixel = std::min(y, size.y - 1) * size.x + std::min(x, size.x - 1);
        return texels[static_cast<std::size_t>(pixel) * 3 + 2];
    };
    return {z(0, 0), z(1, 0), z(0, 1), z(1, 1)};
}

} // namespace

bool hasElevations(const TileSampler& sampler) {
    const TileProducer& producer = sampler.producer();
    const auto* const storage = dynamic_cast<const GpuTileStorage*>(&producer.cache().storage());
    return storage && storage->format().channels >= 3 && !storage->format().integer() &&
           producer.border() == TileSamplerZ::kBorder;
}

std::optional<TileElevation> elevationAt(const TerrainNode& terrain, const TileSampler& sampler,
                                         const glm::dvec2& local) {
    const TerrainQuad& root = terrain.root();
    const glm::dvec2 inRoot = (local - glm::dvec2(root.ox, root.oy)) / root.l;
    const bool inside = inRoot.x >= 0 && inRoot.x <= 1 && inRoot.y >= 0 && inRoot.y <= 1;
    if (!inside) return std::nullopt;
    const TileProducer& producer = sampler.producer();
    const Found found = finestTile(terrain, producer, inRoot);
    if (!found.tile) return std::nullopt;
    const glm::dvec2 texel =
        texelAt(found.inQuad, producer.cache().storage().tileSize(), producer.border());
    const glm::dvec2 corner = glm::floor(texel);
    const glm::dvec2 f = texel - corner;
    const auto z = texelsAround(found.tile->slot().as<GpuTileStorage::Slot>(), glm::ivec2(corner));
    const double elevation = glm::mix(glm::mix(z[0], z[1], f.x), glm::mix(z[2], z[3], f.x), f.y);
    return TileElevation{elevation, found.tile->id().level};
}

} // namespace terrane
