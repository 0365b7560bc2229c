// SPDX-License-Identifier: BSD-3-Clause
#include "producer/tile_cache.h"

#include "producer/tile_producer.h"

#include <algorithm>
#include <cassert>

namespace terrane {

TileCache::TileCache(std::string name, std::shared_ptr<TileStorage> storage,
                     std::shared_ptr<Scheduler> scheduler)
    : name_(std::move(name))
    , storage_(std::move(storage))
    , scheduler_(std::move(scheduler)) {
    assert(storage_ && scheduler_ && "TileCache: needs a storage and a scheduler");
    tiles_.reserve(static_cast<std::size_t>(storage_->capacity()));
}

TileCache::~TileCache() {
    assert(tiles_.empty() && "TileCache: destroyed before its producers");
}

int TileCache::addProducer(TileProducer& producer) {
    // A producer that is built anew gets the id that shaders know it by.
    for (std::size_t id = 0; id < producers_.size(); ++id) {
        if (producers_[id] || producerNames_[id] != producer.name()) continue;
        producers_[id] = &producer;
        return static_cast<int>(id);
    }
    producers_.push_back(&producer);
    producerNames_.push_back(producer.name());
    return static_cast<int>(producers_.size()) - 1;
}

void TileCache::removeProducer(TileProducer& producer) {
    std::vector<Tile*> own;
    for (const auto& [key, tile] : tiles_)
        if (&tile->producer() == &producer) own.push_back(tile.get());
    // Tiles of a producer may hold one another: first nobody produces, then nobody holds.
    for (Tile* tile : own)
        tile->task_->abandon();
    for (Tile* tile : own)
        eraseTile(*tile);
    for (auto entry = evicted_.begin(); entry != evicted_.end();) {
        const bool his = entry->first.producer == producer.serial();
        if (const auto task = his ? entry->second.lock() : nullptr) task->abandon();
        entry = his ? evicted_.erase(entry) : std::next(entry);
    }
    producers_[static_cast<std::size_t>(producer.id())] = nullptr;
}

int TileCache::tilesOf(const TileProducer& producer) const {
    return static_cast<int>(std::count_if(tiles_.begin(), tiles_.end(), [&](const auto& item) {
        return &item.second->producer() == &producer && item.second->done();
    }));
}

Tile* TileCache::find(const TileKey& key) const {
    const auto found = tiles_.find(key);
    return found == tiles_.end() ? nullptr : found->second.get();
}

Tile* TileCache::getTile(TileProducer& producer, const TileId& id, unsigned deadline) {
    const TileKey key{producer.serial(), id};
    Tile* tile = find(key);
    const bool fresh = tile == nullptr;
    if (fresh) tile = addTile(producer, key);
    if (!tile) return refuse(key);
    use(*tile);
    CreateTile& task = *tile->task_;
    tile->deadline_ = std::min(tile->deadline_, deadline);
    task.setDeadline(deadline);
    const bool known = !fresh && (task.done() || task.acquired_);
    ++(known ? counts_.hits : counts_.misses);
    if (known) return tile;
    if (task.acquire()) {
        if (fresh) task.loseData();
        return tile;
    }
    unuse(*tile); // the cache that refused an input knows which slot was missing
    if (fresh) eraseTile(*tile);
    return nullptr;
}

Tile* TileCache::findTile(const TileProducer& producer, const TileId& id, bool includeUnused,
                          bool done) const {
    Tile* const tile = find({producer.serial(), id});
    if (!tile || (!includeUnused && tile->users_ == 0) || (done && !tile->done())) return nullptr;
    return tile;
}

std::shared_ptr<CreateTile> TileCache::prefetchTile(TileProducer& producer, const TileId& id) {
    const TileKey key{producer.serial(), id};
    if (find(key)) return nullptr;
    Tile* const tile = addTile(producer, key);
    if (!tile) return nullptr;
    const std::shared_ptr<CreateTile> task = tile->task_;
    if (!task->acquire()) {
        eraseTile(*tile);
        return nullptr;
    }
    task->loseData();
    return task;
}

// Without users: the newest among the unused ones.
Tile* TileCache::addTile(TileProducer& producer, const TileKey& key) {
    TileSlot* const slot = takeSlot();
    if (!slot) return nullptr;
    auto owned = std::make_unique<Tile>(*this, producer, key, *slot);
    Tile& tile = *owned;
    const auto known = evicted_.find(key);
    if (known != evicted_.end()) {
        tile.task_ = known->second.lock();
        evicted_.erase(known);
    }
    if (!tile.task_) tile.task_ = std::make_shared<CreateTile>(producer, key.tile);
    tile.task_->attach(tile);
    tiles_.emplace(key, std::move(owned));
    linkNewest(tile);
    return &tile;
}

void TileCache::eraseTile(Tile& tile) {
    tile.task_->leave();
    remember(tile.key_, tile.task_);
    if (tile.users_ == 0) unlink(tile);
    storage_->deleteSlot(tile.slot_);
    const TileKey key = tile.key_;
    tiles_.erase(key);
}

TileSlot* TileCache::takeSlot() {
    if (holders_.size() >= sweepAt_) {
        releaseFinished();
        sweepAt_ = std::max<std::size_t>(64, 2 * holders_.size());
    }
    TileSlot* slot = storage_->newSlot();
    if (!slot) slot = evict();
    if (!slot && vainSearches_ < kMostVainSearches) slot = searchSlot();
    vainSearches_ = slot ? 0 : vainSearches_ + 1;
    return slot;
}

// A slot that others hold only because nobody has told them to let go.
TileSlot* TileCache::searchSlot() {
    releaseFinished();
    if (TileSlot* slot = evict()) return slot;
    // Each pass may leave more tiles without users, whose own inputs the next one can take.
    while (revokeUnused())
        if (TileSlot* slot = evict()) return slot;
    return nullptr;
}

// The slot of the least recently used tile that isn't just being produced.
TileSlot* TileCache::evict() {
    for (Tile* tile = oldest_; tile; tile = tile->newer_) {
        if (!tile->task_->detach()) continue;
        ++counts_.evicted;
        remember(tile->key_, tile->task_);
        TileSlot& slot = tile->slot_;
        unlink(*tile);
        const TileKey key = tile->key_;
        tiles_.erase(key);
        return &slot;
    }
    return nullptr;
}

void TileCache::remember(const TileKey& key, const std::shared_ptr<CreateTile>& task) {
    if (task.use_count() == 1) return;
    if (evicted_.size() > 2 * tiles_.size() + 64)
        std::erase_if(evicted_, [](const auto& entry) { return entry.second.expired(); });
    evicted_[key] = task;
}

Tile* TileCache::refuse(const TileKey& key) {
    ++counts_.refused;
    refused_.insert(key);
    const int used = static_cast<int>(tiles_.size()) - unused_;
    needed_ = std::max(needed_, used + static_cast<int>(refused_.size()));
    return nullptr;
}

void TileCache::blame(TileCache& other) {
    if (&other == this) return;
    culprit_ = other.needed_ > 0 ? other.weak_from_this() : other.culprit_;
}

void TileCache::use(Tile& tile) {
    if (tile.users_++ == 0) unlink(tile);
}

void TileCache::unuse(Tile& tile) {
    assert(tile.users_ > 0 && "TileCache::putTile: the tile is not in use");
    if (--tile.users_ > 0) return;
    tile.deadline_ = Task::kWhenever;
    linkNewest(tile);
}

void TileCache::linkNewest(Tile& tile) {
    tile.older_ = newest_;
    tile.newer_ = nullptr;
    (newest_ ? newest_->newer_ : oldest_) = &tile;
    newest_ = &tile;
    ++unused_;
}

void TileCache::unlink(Tile& tile) {
    (tile.older_ ? tile.older_->newer_ : oldest_) = tile.newer_;
    (tile.newer_ ? tile.newer_->older_ : newest_) = tile.older_;
    tile.older_ = tile.newer_ = nullptr;
    --unused_;
}

int TileCache::invalidateTile(TileProducer& producer, const TileId& id) {
    ++invalidations_;
    const TileKey key{producer.serial(), id};
    const auto evicted = evicted_.find(key);
    if (const auto task = evicted == evicted_.end() ? nullptr : evicted->second.lock())
        task->markUndone(Task::Reason::dataChanged);
    Tile* const tile = find(key);
    if (tile) tile->task_->markUndone(Task::Reason::dataChanged);
    return tile ? 1 : 0;
}

int TileCache::invalidateTiles(TileProducer& producer) {
    ++invalidations_;
    int count = 0;
    for (const auto& [key, tile] : tiles_) {
        if (key.producer != producer.serial()) continue;
        tile->task_->markUndone(Task::Reason::dataChanged);
        ++count;
    }
    for (const auto& [key, evicted] : evicted_) {
        if (key.producer != producer.serial()) continue;
        if (const auto task = evicted.lock()) task->markUndone(Task::Reason::dataChanged);
    }
    return count;
}

void TileCache::addHolder(std::shared_ptr<CreateTile> task) {
    if (holders_.empty() || holders_.back() != task) holders_.push_back(std::move(task));
}

void TileCache::releaseFinished() {
    // Releasing may destroy tasks, which release their own inputs: not while the list is walked.
    std::vector<std::shared_ptr<CreateTile>> released;
    const auto finished = std::partition(holders_.begin(), holders_.end(), [](const auto& task) {
        return task->acquired_ && !task->done();
    });
    released.assign(std::make_move_iterator(finished), std::make_move_iterator(holders_.end()));
    holders_.erase(finished, holders_.end());
    for (const auto& task : released)
        task->release();
}

// What is being prepared for later must not keep what is needed now.
bool TileCache::revokeUnused() {
    const auto holders = holders_;
    bool any = false;
    for (const auto& task : holders)
        any |= task->revoke();
    return any;
}

TileCache::Statistics TileCache::statistics() {
    releaseFinished();
    Statistics result = counts_;
    result.capacity = storage_->capacity();
    result.used = static_cast<int>(tiles_.size()) - unused_;
    result.unused = unused_;
    return result;
}

int TileCache::room() {
    releaseFinished();
    return unused_ + storage_->freeSlots();
}

TileCache::Shortage TileCache::shortage() const {
    const auto other = culprit_.lock();
    const TileCache& full = needed_ == 0 && other ? *other : *this;
    Shortage result{.slots = full.storage_->capacity(), .needed = full.needed_};
    if (result.needed > 0)
        result.message = "cache '" + full.name_ + "' has " + std::to_string(result.slots) +
                         " slots; this view needs at least " + std::to_string(result.needed);
    return result;
}

void TileCache::clearShortage() {
    refused_.clear();
    needed_ = 0;
    vainSearches_ = 0;
    if (const auto culprit = culprit_.lock()) {
        culprit_.reset();
        culprit->clearShortage();
    }
}

} // namespace terrane
