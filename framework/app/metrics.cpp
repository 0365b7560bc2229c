// SPDX-License-Identifier: BSD-3-Clause
#include "app/metrics.h"

#include "producer/tile_cache.h"
#include "producer/tile_producer.h"
#include "resource/manager.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace terrane {

namespace {

using Json = nlohmann::ordered_json;

/// Calls visit(name, T&) for each loaded resource that is a T, by name.
template <class T, class Visit>
void forEach(ResourceManager& resources, Visit visit) {
    for (const auto& [name, entry] : resources.entries()) {
        if (auto* found = dynamic_cast<T*>(entry->instance.get())) visit(name, *found);
    }
}

/// Microseconds are enough for people and keep the file small.
double rounded(double milliseconds) {
    return std::round(milliseconds * 1000) / 1000;
}

template <class Map>
typename Map::mapped_type before(const Map& marked, const std::string& name) {
    const auto found = marked.find(name);
    return found == marked.end() ? typename Map::mapped_type{} : found->second;
}

// A reload forgets what it repaired.
std::size_t since(std::size_t now, std::size_t mark) {
    return now > mark ? now - mark : 0;
}

std::uint64_t peakResidentBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024; // Linux tells kilobytes
}

Json toJson(const StartupTimes& times) {
    return {{"context", rounded(times.context)},
            {"load", rounded(times.load)},
            {"compile", rounded(times.compile)},
            {"first_frame", rounded(times.firstFrame)}};
}

Json toJson(const std::vector<FrameTimes>& frames) {
    Json list = Json::array();
    for (const FrameTimes& f : frames) {
        list.push_back({{"cpu_ms", rounded(f.cpu)},
                        {"gl_ms", rounded(f.gl)},
                        {"update_ms", rounded(f.update)},
                        {"draw_ms", rounded(f.draw)},
                        {"tiles", f.tiles}});
    }
    return list;
}

} // namespace

void Metrics::addFrame(const FrameTimes& times) {
    if (frames_.size() < kMostFrames) frames_.push_back(times);
}

void Metrics::addReload(const ReloadReport& report) {
    if (!report.changed || !report.good) return;
    ++marked_.reloads;
    marked_.rebuilt += report.rebuilt.size();
    for (const auto& [producer, tiles] : report.tilesInvalidated)
        marked_.invalidated[producer] += tiles;
}

// The counts of the next producer of the name start from 0, which the difference to those at the
// mark makes up for; unsigned numbers may pass through 0 on the way.
void Metrics::carryOver(const std::string& name, const TileProducer& producer) {
    const TileProducer::Statistics s = producer.statistics();
    marked_.producers[name].tiles -= s.tiles;
    marked_.producers[name].milliseconds -= s.milliseconds;
}

void Metrics::carryOver(const std::string& name, TileCache& cache) {
    const TileCache::Statistics s = cache.statistics();
    marked_.caches[name].hits -= s.hits;
    marked_.caches[name].misses -= s.misses;
    marked_.caches[name].evicted -= s.evicted;
}

void Metrics::mark(ResourceManager& resources) {
    frames_.clear();
    marked_ = {};
    forEach<TileProducer>(resources, [&](const std::string& name, TileProducer& producer) {
        const TileProducer::Statistics s = producer.statistics();
        marked_.producers[name] = {s.tiles, s.milliseconds};
    });
    forEach<TileCache>(resources, [&](const std::string& name, TileCache& cache) {
        const TileCache::Statistics s = cache.statistics();
        marked_.caches[name] = {s.hits, s.misses, s.evicted};
    });
    marked_.errors = resources.diagnostics().errors();
    marked_.warnings = resources.diagnostics().warnings();
}

std::int64_t Metrics::tiles(ResourceManager& resources, const std::string& producer) const {
    std::int64_t count = -1;
    forEach<TileProducer>(resources, [&](const std::string& name, TileProducer& p) {
        if (name != producer) return;
        count =
            static_cast<std::int64_t>(p.statistics().tiles - before(marked_.producers, name).tiles);
    });
    return count;
}

Json Metrics::json(ResourceManager& resources, const Host& host) const {
    Json producers = Json::object(), caches = Json::object();
    forEach<TileProducer>(resources, [&](const std::string& name, TileProducer& producer) {
        const TileProducer::Statistics s = producer.statistics();
        const ProducerCounts b = before(marked_.producers, name);
        producers[name] = {{"tiles", s.tiles - b.tiles},
                           {"ms", rounded(s.milliseconds - b.milliseconds)}};
    });
    forEach<TileCache>(resources, [&](const std::string& name, TileCache& cache) {
        const TileCache::Statistics s = cache.statistics();
        const CacheCounts b = before(marked_.caches, name);
        caches[name] = {{"capacity", s.capacity},
                        {"used", s.used},
                        {"unused", s.unused},
                        {"hits", s.hits - b.hits},
                        {"misses", s.misses - b.misses},
                        {"evicted", s.evicted - b.evicted}};
    });
    const Diagnostics& diagnostics = resources.diagnostics();
    return {{"version", 1},
            {"renderer", host.renderer},
            {"size", {host.width, host.height}},
            {"startup_ms", toJson(startup)},
            {"frames", toJson(frames_)},
            {"producers", producers},
            {"caches", caches},
            {"reloads",
             {{"count", marked_.reloads},
              {"resources", marked_.rebuilt},
              {"tiles_invalidated", Json(marked_.invalidated)}}},
            {"memory", {{"peak_rss_bytes", peakResidentBytes()}, {"gl_objects", host.glObjects}}},
            {"allocations_last_frame", allocationsLastFrame},
            {"diagnostics",
             {{"errors", since(diagnostics.errors(), marked_.errors)},
              {"warnings", since(diagnostics.warnings(), marked_.warnings)}}}};
}

} // namespace terrane
