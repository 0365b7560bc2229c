// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/create_tile.h"
#include "producer/tile_id.h"
#include "resource/resource.h"

#include <glm/vec2.hpp>

namespace terrane {

class TileProducer;
class TileSlot;

/// Changes what a producer, or the layers before, made of a tile: draws roads into colours, digs a
/// river bed. Belongs to one producer. Its hooks are called by the producer's own, in the order of
/// the layers, unless it is disabled (terrain reference 3.5).
class TileLayer : public Resource {
public:
    bool enabled() const { return enabled_; }
    /// A change has all tiles of the producer made again.
    void setEnabled(bool enabled);

    /// Null before the producer has adopted the layer.
    TileProducer* producer() const { return producer_; }

    /// A tile has its first user, or lost its last one.
    virtual void useTile(const TileId&) {}
    virtual void unuseTile(const TileId&) {}
    /// Asks for what the production of a tile reads. False when a cache is full.
    virtual bool startCreateTile(const TileId&, TileInputs&) { return true; }
    /// Around a run of tiles.
    virtual void beginCreateTile() {}
    virtual void endCreateTile() {}
    /// Draws into the producer's target(), whose pipeline state it may change for itself. Returns
    /// whether anything changed.
    virtual bool doCreateTile(const TileId&, TileSlot&, const TileInputs&) = 0;
    /// Prefetches what a tile would read, when the producer can't prefetch the tile itself.
    virtual void prefetchTile(const TileId&) {}
    virtual void setRootQuadSize(float) {}

    /// The tile's lower left corner relative to the root quad's centre, and its edge length.
    TileCoordinates tileCoordinates(const TileId& tile) const;

    /// How lengths in a tile of a sphere's face relate to lengths on the sphere (radius: half the
    /// root quad): a distance of one along the surface is this much in the plane of the face.
    struct Deformation {
        glm::dvec2 nx{1, 0}, ny{0, 1}; ///< normals
        glm::dvec2 lx{1, 0}, ly{0, 1}; ///< lengths
    };
    Deformation deformation(const TileId& tile) const;

private:
    friend class TileProducer;
    TileProducer* producer_ = nullptr;
    bool enabled_ = true;
};

} // namespace terrane
