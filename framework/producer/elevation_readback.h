// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "producer/gpu_tile_storage.h"
#include "producer/tile_cache.h"
#include "render/layer_ranges.h"
#include "render/pixel_readback.h"
#include "scene/scene_task.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec2.hpp>

namespace terrane {

struct ProgramBindings;

/// Tells the CPU some frames later what the elevation tiles of a storage hold: the least and the
/// greatest elevation of each tile, and elevations at points. One for a storage, shared by all
/// samplers of its tiles; reads at most 16 things a frame, points first, then tiles by their levels
/// (terrain reference 3.7). What is known of a tile is kept as long as the tile is in its slot and
/// is not produced again. GL thread. Allocates nothing once it is made.
///
///     each frame, each sampler:
///         readback.beginFrame(scene.frameNumber());
///         for each tile held that is done: if (const auto* range = readback.range(tile)) ...;
///         if (point.arrived) ...;
///         readback.ask(point, tile, texel);
///         if (readback.isAsked()) frame.require(readback.task());
class ElevationReadback {
public:
    static constexpr int kMost = LayerRanges::kMost;
    using Range = LayerRanges::Range;

    /// Where an answer goes. Whoever owns it calls forget() before it dies.
    struct Point {
        bool arrived = false; ///< since somebody set it to false
        float elevation = 0;
        glm::dvec2 place{0}; ///< what was said when it was asked for
    };

    /// The one of a storage. Null, with diagnostics, if OpenGL can't.
    static std::shared_ptr<ElevationReadback> of(GpuTileStorage& storage, int border,
                                                 ProgramBindings& bindings, ReadbackTiming timing,
                                                 Diagnostics& diagnostics);
    ElevationReadback(std::unique_ptr<LayerRanges> ranges, const GpuTileStorage& storage,
                      ReadbackTiming timing);
    ~ElevationReadback();

    /// Takes what has arrived. Only the first call for a frame does something.
    void beginFrame(std::uint64_t frame);
    /// What a tile holds, which must be done and in use. Null as long as it is not known: then it
    /// is read soon. Not a number in it: zmin > zmax.
    const Range* range(const Tile& tile);
    /// Reads an elevation, of a tile that is done and in use, at a point between the centres of its
    /// texels; (0,0) is that of the lower left one, borders included. False when there is no room
    /// for it in this frame. The answer comes with the place.
    bool ask(Point& point, const Tile& tile, const glm::vec2& texel, const glm::dvec2& place);
    void forget(const Point& point);

    /// Something is to be read in this frame, by the task.
    bool isAsked() const { return pointCount_ + tileCount_ > 0; }
    const std::shared_ptr<Task>& task() const { return task_; }
    /// All that was asked for has arrived.
    bool isSettled() const { return !isAsked() && !crowded_ && batchCount_ == 0; }

private:
    class ReadTask;

    /// A tile as it was made at some time.
    struct Version {
        TileKey key;
        Task::Date date = 0;
        bool operator==(const Version&) const = default;
    };
    struct Record { ///< of a slot
        Version asked;
        bool known = false;
        Range range;
    };
    struct Entry {
        const Tile* tile = nullptr; ///< until the end of the frame only
        int slot = -1;
        Version version;
        Point* point = nullptr; ///< null: the range of the tile
        glm::vec2 texel{0};
        glm::dvec2 place{0};
    };
    using Entries = std::array<Entry, kMost>;
    struct Batch {
        Entries entries;
        int count = 0;
    };

    static Version versionOf(const Tile& tile);
    static bool isBefore(const Version& a, const Version& b);
    void offer(const Tile& tile, const Version& version);
    void read();
    void arrive(std::span<const std::byte> pixels);

    const std::unique_ptr<LayerRanges> ranges_;
    const ReadbackTiming timing_;
    PixelReadback readback_;
    std::vector<Record> records_; ///< by slot
    std::uint64_t frame_ = ~std::uint64_t{0};
    Entries points_, tiles_; ///< to be read in this frame; tiles in their order
    int pointCount_ = 0, tileCount_ = 0;
    bool crowded_ = false;                               ///< something had no room in this frame
    std::array<Batch, PixelReadback::kLatency> batches_; ///< on their way: a ring
    int firstBatch_ = 0, batchCount_ = 0;
    std::shared_ptr<Task> task_;
};

} // namespace terrane
