// SPDX-License-Identifier: BSD-3-Clause
#include "producer/tile_producer.h"

#include "producer/gpu_tile_storage.h"
#include "render/framebuffer.h"
#include "task/scheduler.h"

#include <algorithm>
#include <cassert>

namespace terrane {

TileProducer::TileProducer(std::string name, Task::Kind kind, std::string_view taskName,
                           std::shared_ptr<TileCache> cache)
    : name_(std::move(name))
    , kind_(kind)
    , taskName_(taskName)
    , cache_(std::move(cache))
    , serial_(cache_->nextSerial())
    , id_(cache_->addProducer(*this))
    , gpu_(dynamic_cast<GpuTileStorage*>(&cache_->storage()) != nullptr) {}

TileProducer::~TileProducer() {
    retire();
}

void TileProducer::retire() {
    if (retired_) return;
    retired_ = true;
    cache_->removeProducer(*this);
}

void TileProducer::setRootQuadSize(float size) {
    if (rootQuadSize_ != 0 && size != rootQuadSize_) invalidateTiles(); // they count on it
    rootQuadSize_ = size;
    for (const auto& layer : layers_)
        layer->setRootQuadSize(size);
}

Tile* TileProducer::getTile(const TileId& tile, unsigned deadline) {
    Tile* const got = cache_->getTile(*this, tile, deadline);
    if (!got || got->users() > 1) return got;
    for (const auto& layer : layers_)
        layer->useTile(tile);
    return got;
}

void TileProducer::putTile(Tile& tile) {
    assert(&tile.producer() == this && "TileProducer::putTile: tile of another producer");
    const TileId id = tile.id();
    const bool last = tile.users() == 1;
    cache_->putTile(tile);
    if (!last) return;
    for (const auto& layer : layers_)
        layer->unuseTile(id);
}

bool TileProducer::prefetchTile(const TileId& tile) {
    Scheduler& scheduler = cache_->scheduler();
    if (scheduler.supportsPrefetch(kind_)) {
        if (const auto task = cache_->prefetchTile(*this, tile)) scheduler.schedule(task);
        return true;
    }
    for (const auto& layer : layers_)
        layer->prefetchTile(tile);
    return false;
}

bool TileProducer::hasEnabledLayers() const {
    return std::any_of(layers_.begin(), layers_.end(),
                       [](const auto& layer) { return layer->enabled(); });
}

void TileProducer::addLayer(std::shared_ptr<TileLayer> layer) {
    assert(layer && !layer->producer_ && "TileProducer::addLayer: belongs to another producer");
    layer->producer_ = this;
    layer->setRootQuadSize(rootQuadSize_);
    layers_.push_back(std::move(layer));
    invalidateTiles();
}

bool TileProducer::startCreateTile(const TileId& tile, TileInputs& inputs) {
    return std::all_of(layers_.begin(), layers_.end(), [&](const auto& layer) {
        return !layer->enabled() || layer->startCreateTile(tile, inputs);
    });
}

void TileProducer::beginCreateTile() {
    for (const auto& layer : layers_)
        if (layer->enabled()) layer->beginCreateTile();
}

void TileProducer::endCreateTile() {
    for (const auto& layer : layers_)
        if (layer->enabled()) layer->endCreateTile();
}

bool TileProducer::doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs& inputs) {
    bool changed = false;
    Framebuffer* const drawn = target();
    for (const auto& layer : layers_) {
        if (!layer->enabled()) continue;
        const PipelineState before = drawn ? drawn->state : PipelineState();
        changed |= layer->doCreateTile(tile, slot, inputs);
        if (drawn) drawn->state = before;
    }
    return changed;
}

TileProducer::Statistics TileProducer::statistics() const {
    return {tilesMade_.load(std::memory_order_relaxed),
            static_cast<double>(nanoseconds_.load(std::memory_order_relaxed)) * 1e-6};
}

void TileProducer::countTile(std::chrono::steady_clock::duration time) {
    tilesMade_.fetch_add(1, std::memory_order_relaxed);
    nanoseconds_.fetch_add(std::chrono::duration_cast<std::chrono::nanoseconds>(time).count(),
                           std::memory_order_relaxed);
}

} // namespace terrane
