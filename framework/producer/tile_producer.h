// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/tile_cache.h"
#include "producer/tile_layer.h"
#include "resource/resource.h"
#include "task/task.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terrane {

class Framebuffer;
class SceneManager;

/// Makes the tiles of one kind of data of a landscape: elevations, normals, colours, graphs. A tile
/// is asked for with getTile and is made by its task (Tile::task), which runs when it is next part
/// of a task graph and never again until something that it was made from changes.
///
/// A producer says in startCreateTile which tiles it reads, and makes a tile of them in
/// doCreateTile:
///
///     bool startCreateTile(const TileId& tile, TileInputs& inputs) override {
///         return inputs.need(*heights_, tile) && TileProducer::startCreateTile(tile, inputs);
///     }
///     bool doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs& inputs) override {
///         const auto& heights = inputs.get(*heights_,
///         tile).slot().as<CpuFloatTileStorage::Slot>();
///         ...
///         return true; // the data changed
///     }
///
/// Made by makeProducer. Owner (GL) thread only, but doCreateTile of producers of CPU tasks.
class TileProducer : public Resource {
public:
    ~TileProducer() override;

    const std::string& name() const { return name_; }
    TileCache& cache() const { return *cache_; }
    int id() const { return id_; }              ///< among the producers of the cache, from 0
    unsigned serial() const { return serial_; } ///< never given twice
    /// Whether the tiles are layers of textures.
    bool isGpu() const { return gpu_; }
    Task::Kind taskKind() const { return kind_; }
    std::string_view taskName() const { return taskName_; }

    /// Pixels around the quad on each side of a tile.
    virtual int border() const { return 0; }
    /// Length of the root quad's edge; 0 as long as nobody has said it.
    float rootQuadSize() const { return rootQuadSize_; }
    /// Overrides pass it on to the producers that they read.
    virtual void setRootQuadSize(float size);

    virtual bool hasTile(const TileId&) const { return true; }
    /// Whether there are the four tiles below; there are all or none.
    bool hasChildren(const TileId& tile) const { return hasTile(tile.child(0, 0)); }

    /// Called once a frame for each sampler of the tiles, before they are asked for.
    virtual void update(SceneManager&) {}

    /// Acquires a tile, to be released with putTile. Null when no slot can be had (see
    /// TileCache::shortage).
    Tile* getTile(const TileId& tile, unsigned deadline = Task::kImmediate);
    void putTile(Tile& tile);
    Tile* findTile(const TileId& tile, bool includeUnused = false, bool done = false) const {
        return cache_->findTile(*this, tile, includeUnused, done);
    }
    /// Has a tile made for later frames, if the scheduler takes such work; else at least what it is
    /// made from, as far as possible. False when the tile itself will not be made.
    virtual bool prefetchTile(const TileId& tile);
    int invalidateTile(const TileId& tile) { return cache_->invalidateTile(*this, tile); }
    int invalidateTiles() { return cache_->invalidateTiles(*this); }

    const std::vector<std::shared_ptr<TileLayer>>& layers() const { return layers_; }
    bool hasEnabledLayers() const;
    void addLayer(std::shared_ptr<TileLayer> layer);
    /// What layers draw a tile into. Null when they don't draw.
    virtual Framebuffer* target() { return nullptr; }

    /// Asks for the tiles that the production of a tile reads. False when a cache is full.
    /// Overrides call this one too, for the layers.
    virtual bool startCreateTile(const TileId& tile, TileInputs& inputs);
    /// Around a run of tiles with one taskContext(); only called when there is one.
    virtual void beginCreateTile();
    virtual void endCreateTile();
    /// Makes a tile. Returns whether its data changed. Overrides call this one for the layers.
    virtual bool doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs& inputs);
    /// GPU tasks with the same context run one after the other, between one beginCreateTile and one
    /// endCreateTile.
    virtual const void* taskContext() const { return nullptr; }

    /// Since the start; may be read anywhere.
    struct Statistics {
        std::uint64_t tiles = 0;
        double milliseconds = 0; ///< of the producing threads
    };
    Statistics statistics() const;
    void countTile(std::chrono::steady_clock::duration time);

    /// Leaves the cache: tiles are dropped, tasks do nothing from now on. Waits for a tile that is
    /// just being made. makeProducer has it called before the destructor of the derived class.
    void retire();

protected:
    /// @param taskName class name of its tasks, in metrics and traces: "CreateElevationTile"
    TileProducer(std::string name, Task::Kind kind, std::string_view taskName,
                 std::shared_ptr<TileCache> cache);

private:
    const std::string name_;
    const Task::Kind kind_;
    const std::string_view taskName_;
    const std::shared_ptr<TileCache> cache_;
    const unsigned serial_;
    const int id_;
    const bool gpu_;
    bool retired_ = false;
    float rootQuadSize_ = 0;
    std::vector<std::shared_ptr<TileLayer>> layers_;
    std::atomic<std::uint64_t> tilesMade_ = 0;
    std::atomic<std::int64_t> nanoseconds_ = 0;
};

/// The way to make a producer: when the last reference goes, it leaves its cache while it is still
/// whole.
template <class P, class... Arguments>
std::shared_ptr<P> makeProducer(Arguments&&... arguments) {
    auto producer = std::make_unique<P>(std::forward<Arguments>(arguments)...);
    return std::shared_ptr<P>(producer.release(), [](P* p) {
        p->retire();
        std::default_delete<P>()(p);
    });
}

} // namespace terrane
