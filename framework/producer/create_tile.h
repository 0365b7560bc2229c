// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/tile_id.h"
#include "task/task.h"

#include <memory>
#include <mutex>
#include <vector>

namespace terrane {

class CreateTile;
class Tile;
class TileProducer;

/// The tiles that the production of another one reads. They are locked in their caches from the
/// moment they are needed until it is done, and their tasks are predecessors of its task.
class TileInputs {
public:
    /// Acquires a tile; to be called in startCreateTile. False when the producer's cache is full:
    /// give up then, whatever was acquired so far is released.
    bool need(TileProducer& producer, const TileId& tile);

    /// A tile that was acquired; null if it wasn't. Its data may be read while the task runs.
    const Tile* find(const TileProducer& producer, const TileId& tile) const;
    /// A tile that must have been acquired.
    const Tile& get(const TileProducer& producer, const TileId& tile) const;

private:
    friend class CreateTile;
    explicit TileInputs(CreateTile& owner)
        : owner_(owner) {}

    CreateTile& owner_;
    std::vector<Tile*> tiles_;
};

/// Produces one tile into the slot that the cache has given it. There is one object for a tile as
/// long as anybody refers to it, even while the tile is evicted, so that what was made from the
/// tile hears when its data changes (terrain reference 3.4, 3.5).
class CreateTile final : public Task, public std::enable_shared_from_this<CreateTile> {
public:
    CreateTile(TileProducer& producer, const TileId& tile);
    ~CreateTile() override;

    const TileId& tile() const { return tile_; }

    const void* context() const override;
    void begin() override;
    void end() override;
    /// Does nothing when the tile was evicted; does nothing and stays undone without its inputs.
    bool run() override;
    /// Acquires the inputs if the tile is in a cache; due when its users want it.
    void prepare() override;

private:
    friend class TileCache;
    friend class TileInputs;

    /// Acquires the inputs unless it has them. False when a cache is full; it has none then.
    bool acquire();
    void release();
    /// Releases the inputs of a tile that nobody uses, unless it is being produced.
    bool revoke();
    void adoptPredecessors();

    void attach(Tile& home);
    /// Leaves the cache. False, without a change, while the tile is being produced.
    bool detach();
    /// Leaves the cache, after waiting for a run that goes on.
    void leave();
    /// Leaves the producer too.
    void abandon();
    /// Has the tile produced because its slot is new.
    void loseData();

    TileProducer* producer_; ///< null when it is gone
    const TileId tile_;
    Tile* home_ = nullptr; ///< null while the tile is evicted
    TileInputs inputs_;
    bool acquired_ = false;

    std::mutex running_; ///< held by run(), and by the owner thread to change what run() reads
};

} // namespace terrane
