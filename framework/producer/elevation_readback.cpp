// SPDX-License-Identifier: BSD-3-Clause
#include "producer/elevation_readback.h"

#include "producer/tile_producer.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <tuple>

namespace terrane {

class ElevationReadback::ReadTask final : public FrameTask {
public:
    explicit ReadTask(ElevationReadback& owner)
        : FrameTask("ReadElevations")
        , owner_(owner) {}
    bool run() override {
        owner_.read();
        return true;
    }

private:
    ElevationReadback& owner_;
};

std::shared_ptr<ElevationReadback> ElevationReadback::of(GpuTileStorage& storage, int border,
                                                         ProgramBindings& bindings,
                                                         ReadbackTiming timing,
                                                         Diagnostics& diagnostics) {
    if (auto known = storage.elevationReadback.lock()) return known;
    auto ranges = LayerRanges::make(bindings, storage.tileSize(), border, diagnostics);
    if (!ranges) return nullptr;
    auto made = std::make_shared<ElevationReadback>(std::move(ranges), storage, timing);
    if (!made->readback_.usable()) {
        diagnostics.error("out-of-memory", {}, "no memory to read elevations back into");
        return nullptr;
    }
    storage.elevationReadback = made;
    return made;
}

ElevationReadback::ElevationReadback(std::unique_ptr<LayerRanges> ranges,
                                     const GpuTileStorage& storage, ReadbackTiming timing)
    : ranges_(std::move(ranges))
    , timing_(timing)
    , readback_(storage.context(),
                sizeof(Range) * kMost * static_cast<std::size_t>(ranges_->rows()))
    , records_(static_cast<std::size_t>(storage.capacity()))
    , task_(std::make_shared<ReadTask>(*this)) {}

ElevationReadback::~ElevationReadback() = default;

void ElevationReadback::beginFrame(std::uint64_t frame) {
    if (frame == frame_) return;
    frame_ = frame;
    pointCount_ = tileCount_ = 0;
    crowded_ = false;
    for (auto pixels = readback_.take(frame, timing_); !pixels.empty();
         pixels = readback_.take(frame, timing_))
        arrive(pixels);
}

void ElevationReadback::arrive(std::span<const std::byte> pixels) {
    const Batch& batch = batches_[firstBatch_];
    firstBatch_ = (firstBatch_ + 1) % PixelReadback::kLatency;
    --batchCount_;
    const auto rows = static_cast<std::size_t>(ranges_->rows());
    const auto* const all = reinterpret_cast<const Range*>(pixels.data());
    for (int i = 0; i < batch.count; ++i) {
        const Entry& entry = batch.entries[i];
        const std::span<const Range> own(all + static_cast<std::size_t>(i) * rows, rows);
        if (entry.point) {
            *entry.point = {.arrived = true, .elevation = own.front().zmax, .place = entry.place};
            continue;
        }
        if (entry.slot < 0) continue; // nobody waits for it any more
        Record& record = records_[entry.slot];
        if (record.asked != entry.version) continue; // another tile has come there since
        record.range = LayerRanges::combined(own);
        record.known = true;
    }
}

ElevationReadback::Version ElevationReadback::versionOf(const Tile& tile) {
    return {{tile.producer().serial(), tile.id()}, tile.task()->completionDate()};
}

bool ElevationReadback::isBefore(const Version& a, const Version& b) {
    const auto order = [](const Version& v) {
        return std::tuple(v.key.tile.level, v.key.tile.ty, v.key.tile.tx, v.key.producer);
    };
    return order(a) < order(b);
}

const ElevationReadback::Range* ElevationReadback::range(const Tile& tile) {
    assert(tile.done() && tile.users() > 0 && "ElevationReadback::range: tile not ready");
    const Version version = versionOf(tile);
    const Record& record = records_[tile.slot().index()];
    const bool asked = record.asked == version;
    if (asked && record.known) return &record.range;
    if (!asked) offer(tile, version);
    return nullptr;
}

// Keeps the first ones in order of what is offered.
void ElevationReadback::offer(const Tile& tile, const Version& version) {
    const int slot = tile.slot().index();
    const auto end = tiles_.begin() + tileCount_;
    if (std::any_of(tiles_.begin(), end, [&](const Entry& e) { return e.slot == slot; })) return;
    const auto place = std::find_if(tiles_.begin(), end,
                                    [&](const Entry& e) { return isBefore(version, e.version); });
    const bool room = !readback_.full() && tileCount_ < kMost;
    crowded_ |= !room;
    if (!room && (readback_.full() || place == end)) return;
    tileCount_ += room ? 1 : 0;
    std::move_backward(place, tiles_.begin() + tileCount_ - 1, tiles_.begin() + tileCount_);
    *place = {.tile = &tile, .slot = slot, .version = version};
}

bool ElevationReadback::ask(Point& point, const Tile& tile, const glm::vec2& texel,
                            const glm::dvec2& place) {
    assert(tile.done() && tile.users() > 0 && "ElevationReadback::ask: tile not ready");
    const bool room = !readback_.full() && pointCount_ < kMost;
    crowded_ |= !room;
    if (!room) return false;
    points_[pointCount_++] = {.tile = &tile,
                              .slot = tile.slot().index(),
                              .version = versionOf(tile),
                              .point = &point,
                              .texel = texel,
                              .place = place};
    return true;
}

void ElevationReadback::forget(const Point& point) {
    const auto isOf = [&](const Entry& entry) { return entry.point == &point; };
    const auto end = std::remove_if(points_.begin(), points_.begin() + pointCount_, isOf);
    pointCount_ = static_cast<int>(end - points_.begin());
    for (Batch& batch : batches_)
        for (Entry& entry : batch.entries)
            if (isOf(entry)) entry = {}; // its answer goes to no slot
}

void ElevationReadback::read() {
    if (!isAsked()) return;
    Batch& batch = batches_[(firstBatch_ + batchCount_++) % PixelReadback::kLatency];
    batch.count = std::min(kMost, pointCount_ + tileCount_);
    crowded_ |= batch.count < pointCount_ + tileCount_;
    std::array<LayerRanges::Request, kMost> requests;
    for (int i = 0; i < batch.count; ++i) {
        Entry& entry = batch.entries[i];
        entry = i < pointCount_ ? points_[i] : tiles_[i - pointCount_];
        const auto& slot = entry.tile->slot().as<GpuTileStorage::Slot>();
        requests[i] = {.texture = slot.texture().get(), .layer = slot.layer()};
        if (entry.point)
            requests[i].point = entry.texel;
        else
            records_[entry.slot] = {.asked = entry.version};
        entry.tile = nullptr;
    }
    pointCount_ = tileCount_ = 0;
    ranges_->draw(std::span(requests).first(static_cast<std::size_t>(batch.count)));
    readback_.request(frame_, ranges_->framebuffer(), ranges_->rows(), batch.count,
                      LayerRanges::kLayout);
}

} // namespace terrane
