// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/reload_report.h"

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace terrane {

class Diagnostics;
class ResourceManager;
class TileCache;
class TileProducer;

/// What one frame took. Milliseconds of the wall clock; `tiles` counts tasks that made a tile.
struct FrameTimes {
    double cpu = 0;    ///< of the whole frame, without waiting for OpenGL
    double gl = 0;     ///< until OpenGL was done with it, after that
    double update = 0; ///< of frames, bounds and visibilities of the scene
    double draw = 0;   ///< of building and running the task graph
    int tiles = 0;
};

/// Milliseconds from the start of the program's part in each phase.
struct StartupTimes {
    double context = 0;    ///< creating the OpenGL context
    double load = 0;       ///< reading archives and building resources
    double compile = 0;    ///< binding the methods, which compiles and links their programs
    double firstFrame = 0; ///< drawing the first frame
};

/// Counts of a player, since its start or the last mark, as JSON version 1 (docs/performance.md).
/// Nothing but frames is counted here: the other numbers are asked for when they are needed.
class Metrics {
public:
    /// Frames beyond this many since the last mark are not kept.
    static constexpr std::size_t kMostFrames = 100000;

    StartupTimes startup;
    std::uint64_t allocationsLastFrame = 0;

    /// Makes room, so that adding frames does not count as an allocation of theirs.
    void reserve() { frames_.reserve(4096); }
    void addFrame(const FrameTimes& times);
    void addReload(const ReloadReport& report);
    /// A reload replaces them by others of the same name: what these made still counts.
    void carryOver(const std::string& name, const TileProducer& producer);
    void carryOver(const std::string& name, TileCache& cache);
    /// Counters start again.
    void mark(ResourceManager& resources);

    /// What the metrics need to know of the player beside its resources.
    struct Host {
        std::string renderer;
        int width = 0, height = 0;
        int glObjects = 0;
    };
    nlohmann::ordered_json json(ResourceManager& resources, const Host& host) const;

    /// Tiles that a producer has made since the last mark; -1 when there is no such producer.
    std::int64_t tiles(ResourceManager& resources, const std::string& producer) const;

private:
    struct ProducerCounts {
        std::uint64_t tiles = 0;
        double milliseconds = 0;
    };
    struct CacheCounts {
        std::uint64_t hits = 0, misses = 0, evicted = 0;
    };
    struct Counts {
        std::map<std::string, ProducerCounts> producers;
        std::map<std::string, CacheCounts> caches;
        std::size_t errors = 0, warnings = 0;
        std::uint64_t reloads = 0, rebuilt = 0; ///< since the mark, as the next
        std::map<std::string, std::int64_t> invalidated;
    };

    std::vector<FrameTimes> frames_;
    Counts marked_;
};

} // namespace terrane
