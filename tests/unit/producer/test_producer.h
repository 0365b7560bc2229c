// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/cpu_tile_storage.h"
#include "producer/tile_cache.h"
#include "producer/tile_producer.h"
#include "task/multithread_scheduler.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace terrane::test {

/// Tiles of one number: that of the tile itself, plus those of the inputs. What a tile must hold is
/// known at any time by expected().
class SumProducer final : public TileProducer {
public:
    SumProducer(std::string name, std::shared_ptr<TileCache> cache,
                std::vector<std::shared_ptr<SumProducer>> inputs = {}, bool needsParent = false,
                Task::Kind kind = Task::Kind::cpu)
        : TileProducer(std::move(name), kind, "CreateSum", std::move(cache))
        , inputs_(std::move(inputs))
        , needsParent_(needsParent) {}

    /// All tiles change when it does, but are made anew only if they are invalidated.
    std::atomic<int> version = 0;
    std::atomic<int> made = 0;
    int begun = 0, ended = 0;
    bool contextual = false;

    bool startCreateTile(const TileId& tile, TileInputs& inputs) override {
        if (needsParent_ && tile.level > 0 && !inputs.need(*this, tile.parent())) return false;
        for (const auto& input : inputs_)
            if (!inputs.need(*input, tile)) return false;
        return TileProducer::startCreateTile(tile, inputs);
    }
    bool doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs& inputs) override {
        ++made;
        float sum = own(tile);
        if (needsParent_ && tile.level > 0) sum += value(inputs.get(*this, tile.parent()));
        for (const auto& input : inputs_)
            sum += value(inputs.get(*input, tile));
        float& stored = slot.as<CpuFloatTileStorage::Slot>().data()[0];
        const bool changed = stored != sum || !everSame_;
        stored = sum;
        return changed;
    }
    void beginCreateTile() override { ++begun; }
    void endCreateTile() override { ++ended; }
    const void* taskContext() const override { return contextual ? this : nullptr; }

    static float value(const Tile& tile) {
        return tile.slot().as<CpuFloatTileStorage::Slot>().data()[0];
    }
    float expected(const TileId& tile) const {
        float sum = own(tile);
        if (needsParent_ && tile.level > 0) sum += expected(tile.parent());
        for (const auto& input : inputs_)
            sum += input->expected(tile);
        return sum;
    }
    /// Reports no change when a tile comes out as it was.
    void compareResults() { everSame_ = true; }

private:
    float own(const TileId& tile) const {
        return static_cast<float>(tile.level * 10000 + tile.ty * 100 + tile.tx + 1000 * version);
    }

    std::vector<std::shared_ptr<SumProducer>> inputs_;
    bool needsParent_;
    bool everSame_ = false;
};

struct ProducerFixture {
    explicit ProducerFixture(unsigned threads = 0)
        : scheduler(std::make_shared<MultithreadScheduler>(
              MultithreadScheduler::Options{.nthreads = threads})) {}
    ~ProducerFixture() { scheduler->drop(); }

    std::shared_ptr<MultithreadScheduler> scheduler;
    TaskGraph graph;

    std::shared_ptr<TileCache> makeCache(int slots, const std::string& name = "cache") {
        return std::make_shared<TileCache>(name, std::make_shared<CpuFloatTileStorage>(1, 1, slots),
                                           scheduler);
    }
    /// Makes the data of tiles, as a frame does.
    void run(const std::vector<Tile*>& tiles) {
        graph.clear();
        for (Tile* tile : tiles)
            graph.add(tile->task());
        scheduler->run(graph);
        graph.clear();
    }
};

} // namespace terrane::test
