// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/elevation_readback.h"
#include "terrain/tile_sampler.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include <glm/vec2.hpp>

namespace terrane {

/// A sampler of elevation tiles that reads them back some frames later: the lowest and the highest
/// point of each tile go to its quad, so that what can't be seen isn't drawn; the height of the
/// ground below the camera goes to the terrain (terrain reference 1.5, 3.7). GL thread.
///
/// The height is that of the finest tile below the camera, between its texels. A camera that moves
/// steadily gets the height of where it will be when the answer is there; on a planet the face that
/// is there tells it. Tiles below the camera are always needed.
///
/// Quads that are not drawn only because of elevations that they inherited are measured one after
/// the other, as long as there is room for their tiles: what stands out of them is seen some frames
/// later, and the picture is not complete before. When tiles are made again, or the sampler is
/// new, what was measured of others is forgotten, too.
class TileSamplerZ final : public TileSampler {
public:
    /// Of the tiles, whose channel z is the elevation.
    static constexpr int kBorder = 2;

    TileSamplerZ(Parameters parameters, std::shared_ptr<ElevationReadback> readback);
    ~TileSamplerZ() override;

    void update(TerrainNode& terrain, SceneManager& scene, FrameBuilder& frame) override;
    bool followsCamera() const override { return true; }

    /// Nothing that was asked for, by any sampler of these tiles, is still to come.
    bool isSettled(std::uint64_t frame) const override {
        return updatedIn_ != frame || (!waiting_ && !doubting_ && readback_->isSettled());
    }

protected:
    bool needs(const TerrainNode& terrain, const TerrainQuad& quad) const override;

private:
    /// What was last asked for.
    struct Sample {
        const Tile* tile = nullptr;
        TileId id;
        Task::Date date = 0;
        glm::dvec2 texel{0};
    };

    void chooseDoubtful(const TerrainNode& terrain);
    bool isChosen(const TerrainQuad& quad) const;
    void measureQuads(TerrainNode& terrain);
    void forgetUnheld(TerrainNode& terrain);
    void takeSample(TerrainNode& terrain, std::uint64_t frame);
    void followGround(TerrainNode& terrain, std::uint64_t frame);
    glm::dvec2 whereCameraWillBe(const TerrainState& state);
    const TerrainQuad* finestQuad(const TerrainNode& terrain, const glm::dvec2& local) const;

    const std::shared_ptr<ElevationReadback> readback_;
    ElevationReadback::Point point_;
    Sample sample_;
    /// Doubtful quads that are to get a tile in this frame, so that they are measured. So few, for
    /// frames to stay short.
    std::array<int, 8> chosen_{};
    int chosenCount_ = 0;
    bool doubting_ = false; ///< a doubtful quad has a tile, or is to get one
    /// Of the cache that the measurements have heard of; none before the first update, since
    /// another sampler may have measured other tiles on this terrain before a reload.
    std::optional<std::uint64_t> invalidations_;
    std::optional<std::uint64_t> updatedIn_; ///< number of the frame
    bool waiting_ = false; ///< there was no room to ask for what is below the camera
    bool moving_ = false;  ///< the next two are those of the frame before
    glm::dvec2 camera_{0}, step_{0};
};

} // namespace terrane
