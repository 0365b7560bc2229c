// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plugins/terrain/noise.h"
#include "plugins/terrain/residual_source.h"
#include "producer/gpu_tile_storage.h"
#include "producer/tile_pass.h"
#include "producer/tile_producer.h"

#include <memory>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

namespace terrane {

/// Elevations (zf, zc, zm) of a terrain: each tile is its parent's, upsampled, plus residuals from
/// a file, plus noise; layers may change zm (terrain reference 1.7, 2.4, 2.5). zf is the elevation,
/// zc that of the parent's mesh at the same place, zm what is shown. Tiles are (n+5)^2 texels,
/// texel (2,2) at the quad's corner, n texels to the next.
class ElevationProducer final : public TileProducer {
public:
    static constexpr int kBorder = 2;

    struct Parameters {
        std::string name;
        std::shared_ptr<TileCache> cache; ///< of a GpuTileStorage of floats
        /// Of floats on the CPU, one channel, border 2; or null.
        std::shared_ptr<TileProducer> residuals;
        std::shared_ptr<Program> upsample;
        int gridSize = 24;        ///< quads of the mesh along an edge; divides n
        std::vector<float> noise; ///< amplitude for each level, metres; none beyond
        bool flip = false;        ///< the mesh's diagonals follow the ridges
        int face = 0;             ///< of a planet, 1 to 6

        std::shared_ptr<Texture> target;          ///< RGBA32F, tileSize^2
        std::shared_ptr<Texture> residualTexture; ///< R32F, tileSize^2; with residuals
        std::shared_ptr<Program> blend;           ///< with layers, and so is the next
        std::shared_ptr<Texture> blendTarget;     ///< RGBA32F, tileSize^2
    };

    ElevationProducer(const GlContext& context, Parameters parameters);

    int border() const override { return kBorder; }
    void setRootQuadSize(float size) override;
    bool prefetchTile(const TileId& tile) override;
    Framebuffer* target() override { return &pass_.framebuffer(); }

    bool startCreateTile(const TileId& tile, TileInputs& inputs) override;
    bool doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs& inputs) override;
    const void* taskContext() const override { return this; }

private:
    void setParent(const TileId& tile, const GpuTileStorage::Slot& slot, const TileInputs& inputs);
    void setResidual(const TileId& tile, const TileInputs& inputs);
    void setNoise(const TileId& tile);
    void blendLayers(const TileId& tile, TileSlot& slot, const TileInputs& inputs);

    Parameters parameters_;
    const int width_; ///< of tiles, n + 5
    const int n_;
    const ResidualSource residuals_;
    TilePass pass_;
    std::shared_ptr<Texture> noiseTexture_;
    const GradientNoise gradients_;
    std::vector<float> residualTexels_;

    Uniform<glm::vec4> tileWSDF_, coarseLevelOSL_, residualOSH_, noiseUVLH_;
    Uniform<Texture> coarseLevelSampler_, residualSampler_, noiseSampler_;
    Uniform<Texture> blendSampler_;
    Uniform<float> blendScale_;
};

} // namespace terrane
