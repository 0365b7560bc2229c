// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/gpu_tile_storage.h"
#include "producer/tile_pass.h"
#include "producer/tile_producer.h"

#include <memory>
#include <string>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace terrane {

/// Normals of a terrain from its elevations: x and y in the tangent frame at the tile's centre;
/// with four channels also those of the parent's mesh (terrain reference 1.7, 2.6). Tiles are
/// (n+1)^2 texels for elevation tiles of (n+5)^2.
class NormalProducer final : public TileProducer {
public:
    struct Parameters {
        std::string name;
        std::shared_ptr<TileCache> cache; ///< of a GpuTileStorage with 2 or 4 channels
        std::shared_ptr<TileProducer> elevations;
        std::shared_ptr<Program> program;
        int gridSize = 24; ///< quads of the mesh along an edge; divides n
        bool sphere = false;
        std::shared_ptr<Texture> target; ///< tileSize^2, in a format that can be drawn into
    };

    NormalProducer(const GlContext& context, Parameters parameters);

    void setRootQuadSize(float size) override;
    bool hasTile(const TileId& tile) const override {
        return parameters_.elevations->hasTile(tile);
    }
    Framebuffer* target() override { return &pass_.framebuffer(); }

    bool startCreateTile(const TileId& tile, TileInputs& inputs) override;
    bool doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs& inputs) override;
    const void* taskContext() const override { return this; }

private:
    bool readsParent(const TileId& tile) const { return fourChannels_ && tile.level > 0; }
    void setElevations(const TileId& tile, const TileInputs& inputs);
    void setParent(const TileId& tile, const GpuTileStorage::Slot& slot, const TileInputs& inputs);
    void setFrame(const TileId& tile);

    Parameters parameters_;
    const int width_;
    bool fourChannels_;
    float format_; ///< 0: 4 signed channels, 1: 4 unsigned, 2: 2 signed, 3: 2 unsigned
    TilePass pass_;

    Uniform<glm::vec3> tileSDF_;
    Uniform<Texture> elevationSampler_, normalSampler_;
    Uniform<glm::vec4> elevationOSL_, normalOSL_, patchCornerNorms_, deform_;
    Uniform<glm::mat4> patchCorners_, patchVerticals_;
    Uniform<glm::mat3> worldToTangentFrame_, parentToTangentFrame_;
};

} // namespace terrane
