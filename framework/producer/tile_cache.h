// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/create_tile.h"
#include "producer/tile_id.h"
#include "producer/tile_storage.h"
#include "resource/resource.h"

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace terrane {

class Scheduler;
class TileCache;
class TileProducer;

/// A tile that has a slot. In use, and then locked, or kept until its slot is needed for another.
class Tile {
public:
    const TileId& id() const { return key_.tile; }
    TileProducer& producer() const { return producer_; }
    TileCache& cache() const { return cache_; }
    TileSlot& slot() const { return slot_; }
    int users() const { return users_; }

    /// The task that produces it; the same object for as long as the tile is known.
    const std::shared_ptr<CreateTile>& task() const { return task_; }
    /// Whether the slot holds up-to-date data.
    bool done() const { return task_->done(); }

    Tile(TileCache& cache, TileProducer& producer, const TileKey& key, TileSlot& slot)
        : cache_(cache)
        , producer_(producer)
        , key_(key)
        , slot_(slot) {}

private:
    friend class CreateTile;
    friend class TileCache;

    TileCache& cache_;
    TileProducer& producer_;
    const TileKey key_;
    TileSlot& slot_;
    std::shared_ptr<CreateTile> task_;
    int users_ = 0;
    unsigned deadline_ = Task::kWhenever; // the earliest that a user asked for
    Tile* older_ = nullptr;               // among the unused ones
    Tile* newer_ = nullptr;
};

/// Maps tiles to slots of a storage. Tiles with users are locked; of the others, those that were
/// released longest ago give their slots away first (terrain reference 3.4). Used through the
/// TileProducers that share it; producers' tiles are told apart by TileProducer::serial.
///
/// Owner (GL) thread only: tasks on workers get their slot and inputs beforehand, and what they
/// held is released here, when it is needed or when statistics are asked for.
class TileCache : public Resource, public std::enable_shared_from_this<TileCache> {
public:
    struct Statistics {
        int capacity = 0; ///< slots of the storage
        int used = 0;
        int unused = 0;
        std::uint64_t hits = 0;    ///< getTile: the data is there, or about to be made
        std::uint64_t misses = 0;  ///< getTile: it has to be made, or made again
        std::uint64_t evicted = 0; ///< unused tiles that gave their slot away
        std::uint64_t refused = 0; ///< requests that found no slot
    };

    /// @param name for messages
    TileCache(std::string name, std::shared_ptr<TileStorage> storage,
              std::shared_ptr<Scheduler> scheduler);
    ~TileCache() override;

    const std::string& name() const { return name_; }
    TileStorage& storage() const { return *storage_; }
    Scheduler& scheduler() const { return *scheduler_; }
    /// By their ids. An id whose producer is gone is null until a producer of that name comes back.
    const std::vector<TileProducer*>& producers() const { return producers_; }

    /// Acquires a tile: it stays until putTile. Its task may have to be run before it has data.
    /// Null when no slot can be had, for it or for what it is made from; see shortage().
    Tile* getTile(TileProducer& producer, const TileId& id, unsigned deadline);
    /// Releases a tile.
    void putTile(Tile& tile) { unuse(tile); }
    /// Looks a tile up, without a change.
    /// @param includeUnused whether those without users count
    /// @param done whether only those with data count
    Tile* findTile(const TileProducer& producer, const TileId& id, bool includeUnused,
                   bool done) const;
    /// Makes room for a tile that may be needed later. Returns the task to be scheduled; null when
    /// the tile is here already, or when there is no room.
    std::shared_ptr<CreateTile> prefetchTile(TileProducer& producer, const TileId& id);

    /// Has tiles produced again when they are next needed, and all that was made from them. Returns
    /// how many of them are here.
    int invalidateTile(TileProducer& producer, const TileId& id);
    int invalidateTiles(TileProducer& producer);
    /// Counts the calls of these two, for those who keep what they know of tiles that are gone.
    std::uint64_t invalidations() const { return invalidations_; }

    Statistics statistics();
    /// Tiles of a producer that hold up-to-date data.
    int tilesOf(const TileProducer& producer) const;
    /// Tiles without users plus free slots: what may be asked for without a refusal.
    int room();

    /// Why getTile returned null, since the last clearShortage(): this cache was full, or another
    /// one with tiles that its own are made from.
    struct Shortage {
        int slots = 0;  ///< of the full cache
        int needed = 0; ///< at least so many tiles are needed at once; 0 when nothing was refused
        /// "cache 'x' has 64 slots; this view needs at least 93"
        std::string message;
    };
    Shortage shortage() const;
    /// To be called once a frame, before the tiles of the frame are asked for.
    void clearShortage();

private:
    friend class CreateTile;
    friend class TileInputs;
    friend class TileProducer;

    unsigned nextSerial() { return ++serial_; }
    int addProducer(TileProducer& producer);
    void removeProducer(TileProducer& producer);

    Tile* find(const TileKey& key) const;
    Tile* addTile(TileProducer& producer, const TileKey& key);
    void eraseTile(Tile& tile);
    TileSlot* takeSlot();
    TileSlot* searchSlot();
    TileSlot* evict();
    void remember(const TileKey& key, const std::shared_ptr<CreateTile>& task);
    Tile* refuse(const TileKey& key);
    void blame(TileCache& other);

    void use(Tile& tile);
    void unuse(Tile& tile);
    void linkNewest(Tile& tile);
    void unlink(Tile& tile);

    void addHolder(std::shared_ptr<CreateTile> task);
    void releaseFinished();
    bool revokeUnused();

    const std::string name_;
    const std::shared_ptr<TileStorage> storage_;
    const std::shared_ptr<Scheduler> scheduler_;
    std::vector<TileProducer*> producers_;
    std::vector<std::string> producerNames_; ///< by id, kept after they are gone

    std::unordered_map<TileKey, std::unique_ptr<Tile>, TileKeyHash> tiles_;
    Tile* oldest_ = nullptr;
    Tile* newest_ = nullptr;
    int unused_ = 0;

    /// Tasks of evicted tiles that something else still refers to.
    std::unordered_map<TileKey, std::weak_ptr<CreateTile>, TileKeyHash> evicted_;
    /// Tasks that hold tiles of this cache as their inputs, or did so until lately.
    std::vector<std::shared_ptr<CreateTile>> holders_;
    std::size_t sweepAt_ = 64;

    unsigned serial_ = 0;
    std::uint64_t invalidations_ = 0;

    Statistics counts_;
    std::unordered_set<TileKey, TileKeyHash> refused_; ///< since clearShortage()
    int needed_ = 0;
    /// How often in a row no slot was found, since clearShortage(). After so many times one is no
    /// longer searched for everywhere: a view may ask for a hundred times what there is.
    int vainSearches_ = 0;
    static constexpr int kMostVainSearches = 64;
    std::weak_ptr<TileCache> culprit_; ///< the other cache that was full
};

} // namespace terrane
