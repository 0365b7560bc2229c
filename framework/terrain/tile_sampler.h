// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/tile_producer.h"
#include "resource/value.h"
#include "terrain/terrain_node.h"
#include "terrain/tile_location.h"

#include <cstdint>
#include <string>
#include <vector>

namespace terrane {

class Diagnostics;
class FrameBuilder;
class Registry;
class SceneManager;

/// Links a terrain to a producer of GPU tiles: acquires a tile for each quad that needs one, keeps
/// it as long as it does, and tells shaders where it is (terrain reference 1.5, 3.5). GL thread.
class TileSampler : public Resource {
public:
    struct Parameters {
        std::string uniform; ///< name of the `samplerTile` variable
        Ref<TileProducer> producer;
        bool storeLeaf = true;      ///< leaves need tiles
        bool storeParent = true;    ///< divided quads, too
        bool storeInvisible = true; ///< quads outside of the view, too
        Place place;                ///< for messages
    };

    explicit TileSampler(Parameters parameters);
    ~TileSampler() override;

    const Parameters& parameters() const { return parameters_; }
    TileProducer& producer() const { return *producer_; }

    /// Releases and acquires tiles for the quads of now. The frame waits for those that have to be
    /// produced. A full cache is reported ("cache-full"), and again when a quarter more is needed;
    /// quads then do with ancestors.
    virtual void update(TerrainNode& terrain, SceneManager& scene, FrameBuilder& frame);

    /// The tile of a quad, or of its nearest ancestor that has one with data.
    TileLocation locate(const TerrainNode& terrain, const TerrainQuad& quad) const;

    /// The one of the last update; null before.
    const TerrainNode* terrain() const { return terrain_; }
    /// Whether the quads below the camera are wanted even when it can't see them.
    virtual bool followsCamera() const { return false; }
    /// Nothing that it asked the GPU for is still to come, or it was not updated in the last frame
    /// drawn, which had this number, and takes nothing any more.
    virtual bool isSettled(std::uint64_t) const { return true; }

protected:
    virtual bool needs(const TerrainNode& terrain, const TerrainQuad& quad) const;
    /// The tile that is held for a quad; null when there is none.
    const Tile* held(const TerrainQuad& quad) const;
    /// Indices of the quads with a tile.
    const std::vector<int>& heldQuads() const { return heldQuads_; }
    /// Whether the tile of a quad of heldQuads() was made again since the last call for it, while
    /// it was held.
    bool wasMadeAgain(int index);

private:
    /// The tile held for the quad at this place of the pool.
    struct Held {
        Tile* tile = nullptr;
        std::uint32_t generation = 0;
        Task::Date date = 0; ///< of the data when wasMadeAgain() was last asked; 0: none yet
    };

    void release(const TerrainNode& terrain);
    void acquire(const TerrainNode& terrain);
    void releaseAll();
    void require(FrameBuilder& frame);
    void reportShortage(Diagnostics& diagnostics);

    Parameters parameters_;
    std::shared_ptr<TileProducer> producer_; ///< whose tiles are held, whatever a reload brings
    const TerrainNode* terrain_ = nullptr;   ///< whose quads are held
    std::vector<Held> held_;                 ///< by index of the quad
    std::vector<int> heldQuads_;             ///< indices with a tile
    std::vector<int> queue_;                 ///< quads to visit, coarse ones first
    bool refused_ = false;                   ///< the last update did not get all tiles
    int reportedNeed_ = 0;                   ///< slots that the last report asked for
};

/// <tileSampler>, <tileSamplerZ>
void declareTileSampler(Registry& registry);

} // namespace terrane
