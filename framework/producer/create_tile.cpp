// SPDX-License-Identifier: BSD-3-Clause
#include "producer/create_tile.h"

#include "producer/tile_cache.h"
#include "producer/tile_producer.h"

#include <algorithm>
#include <cassert>
#include <chrono>

namespace terrane {

bool TileInputs::need(TileProducer& producer, const TileId& tile) {
    Tile* const input = producer.getTile(tile, owner_.deadline());
    if (!input) {
        owner_.home_->cache().blame(producer.cache());
        return false;
    }
    tiles_.push_back(input);
    producer.cache().addHolder(owner_.shared_from_this());
    return true;
}

const Tile* TileInputs::find(const TileProducer& producer, const TileId& tile) const {
    for (const Tile* input : tiles_)
        if (&input->producer() == &producer && input->id() == tile) return input;
    return nullptr;
}

const Tile& TileInputs::get(const TileProducer& producer, const TileId& tile) const {
    const Tile* const input = find(producer, tile);
    assert(input && "TileInputs::get: startCreateTile did not ask for this tile");
    return *input;
}

CreateTile::CreateTile(TileProducer& producer, const TileId& tile)
    : Task(producer.taskKind(), producer.taskName(), Task::kWhenever)
    , producer_(&producer)
    , tile_(tile)
    , inputs_(*this) {}

CreateTile::~CreateTile() {
    release();
}

const void* CreateTile::context() const {
    return producer_ ? producer_->taskContext() : nullptr;
}

void CreateTile::begin() {
    if (producer_) producer_->beginCreateTile();
}

void CreateTile::end() {
    if (producer_) producer_->endCreateTile();
}

bool CreateTile::run() {
    const std::lock_guard lock(running_);
    if (!home_ || !acquired_) {
        // Dependents know already (see prepare and revoke): only this task stays undone.
        if (home_) markUndone(Reason::dependencyChanged);
        return false;
    }
    const auto start = std::chrono::steady_clock::now();
    const bool changed = producer_->doCreateTile(tile_, home_->slot(), inputs_);
    producer_->countTile(std::chrono::steady_clock::now() - start);
    return changed;
}

void CreateTile::prepare() {
    if (!home_) return;
    setDeadline(home_->deadline_);
    if (!acquire()) markUndone(Reason::dependencyChanged);
}

bool CreateTile::acquire() {
    if (acquired_) return true;
    assert(home_ && producer_ && "CreateTile::acquire: the tile is in no cache");
    // A tile is in use while it acquires its inputs, which may need slots of the same cache.
    Tile& tile = *home_;
    tile.cache().use(tile);
    const bool got = producer_->startCreateTile(tile_, inputs_);
    if (got) {
        adoptPredecessors();
        const std::lock_guard lock(running_);
        acquired_ = true;
    } else {
        for (Tile* input : inputs_.tiles_)
            input->producer().putTile(*input);
        inputs_.tiles_.clear();
    }
    tile.cache().unuse(tile);
    return got;
}

// Adding an input anew would make everything undone that was made from this tile, so the same
// inputs as the last time stay as they are.
void CreateTile::adoptPredecessors() {
    const auto& before = predecessors();
    const auto isInput = [this](const std::shared_ptr<Task>& task) {
        return std::any_of(inputs_.tiles_.begin(), inputs_.tiles_.end(),
                           [&](const Tile* input) { return input->task() == task; });
    };
    if (!std::all_of(before.begin(), before.end(), isInput)) clearPredecessors();
    for (const Tile* input : inputs_.tiles_)
        addPredecessor(input->task());
}

void CreateTile::release() {
    if (!acquired_) return;
    {
        const std::lock_guard lock(running_);
        acquired_ = false;
    }
    for (Tile* input : inputs_.tiles_)
        input->producer().putTile(*input);
    inputs_.tiles_.clear();
}

bool CreateTile::revoke() {
    if (!acquired_ || (home_ && home_->users() > 0)) return false;
    if (!running_.try_lock()) return false;
    running_.unlock();
    markUndone(Reason::dependencyChanged); // a run that is scheduled already won't get it done
    release();                             // waits if just now that run has started
    return true;
}

void CreateTile::attach(Tile& home) {
    const std::lock_guard lock(running_);
    home_ = &home;
}

bool CreateTile::detach() {
    {
        const std::unique_lock lock(running_, std::try_to_lock);
        if (!lock) return false;
        home_ = nullptr;
    }
    release();
    return true;
}

void CreateTile::leave() {
    {
        const std::lock_guard lock(running_);
        home_ = nullptr;
    }
    release();
}

void CreateTile::abandon() {
    leave();
    producer_ = nullptr;
}

void CreateTile::loseData() {
    // One that isn't done may be about to end on a worker, for the slot that it had before or in
    // vain: that must not count.
    markUndone(done() ? Reason::dataNeeded : Reason::dataChanged);
}

} // namespace terrane
