// SPDX-License-Identifier: BSD-3-Clause
#include "producer/declare.h"

#include "producer/cpu_tile_storage.h"
#include "producer/gpu_tile_storage.h"
#include "producer/object_tile_storage.h"
#include "producer/tile_cache.h"
#include "producer/tile_producer.h"
#include "render/sampling_attributes.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"
#include "task/scheduler.h"

namespace terrane {

namespace {

struct GpuTileStorageDescription : ElementDescription, SamplingAttributes {
    Attr<int> tileSize = 1;
    Attr<int> nTiles = 1;
    Attr<InternalFormat> internalformat = InternalFormat::rgba8;
    Attr<TransferFormat> format = TransferFormat::rgba;
    Attr<TransferType> type = TransferType::u8;
    Attr<bool> tileMap = false;
};

// More than any cache needs, and few enough for the book-keeping of each.
constexpr int kMostTiles = 1 << 22;
// More than the memory of any machine that draws: a slip of the pen.
constexpr double kMaxBytes = 64e9;

std::shared_ptr<GpuTileStorage> buildGpuTileStorage(const GpuTileStorageDescription& d,
                                                    BuildContext& context) {
    const GlContext& gl = context.service<GlContext>();
    const GpuTileStorage::Description description{.tileSize = d.tileSize,
                                                  .tiles = d.nTiles,
                                                  .format = d.internalformat,
                                                  .transfer = {d.format, d.type},
                                                  .sampling = d.sampling(),
                                                  .tileMap = d.tileMap};
    const int maxLayers = gl.maxArrayLayers();
    const std::string problem = GpuTileStorage::problem(gl, description, maxLayers);
    if (!problem.empty()) {
        const bool map = d.tileMap && d.nTiles > maxLayers;
        context.diagnostics().error("bad-texture", map ? d.tileMap.place : d.tileSize.place,
                                    problem);
        return nullptr;
    }
    auto storage = std::make_shared<GpuTileStorage>(gl, description, maxLayers);
    for (const auto& texture : storage->textures()) {
        if (texture->allocated()) continue;
        context.diagnostics().error("out-of-memory", d.nTiles.place,
                                    "there is no memory for so many tiles",
                                    "fewer, or smaller, tiles");
        return nullptr;
    }
    storage->setPlaces(d.tileSize.place, d.internalformat.place);
    return storage;
}

void declareGpuTileStorage(Registry& registry) {
    using D = GpuTileStorageDescription;
    auto storage = registry.resource<GpuTileStorage, D, TileStorage>(
        "gpuTileStorage", "Raster tiles on the GPU, as layers of 2D array textures.");
    storage.attribute("tileSize", &D::tileSize, "edge of a tile, borders included")
        .unit("pixels")
        .required()
        .atLeast(1)
        .attribute("nTiles", &D::nTiles, "number of tiles")
        .required()
        .atLeast(1)
        .atMost(kMostTiles)
        .attribute("internalformat", &D::internalformat, "how pixels are stored",
                   internalFormatWords())
        .required()
        .attribute("format", &D::format, "channels of uploaded pixels", transferFormatWords())
        .required()
        .attribute("type", &D::type, "type of a channel of uploaded pixels", transferTypeWords())
        .required();
    declareFilters(storage);
    storage
        .attribute("tileMap", &D::tileMap,
                   "keep the map that the shader function textureQuadtree needs; all tiles must "
                   "fit in one array texture")
        .check([](const D& d, Diagnostics& diagnostics) { d.checkSampling(diagnostics); })
        .build(buildGpuTileStorage);
}

struct CpuTileStorageDescription : ElementDescription {
    Attr<int> tileSize = 1;
    Attr<int> channels = 1;
    Attr<int> capacity = 1;
};

template <class T>
void declareCpuTileStorage(Registry& registry, const std::string& tag, std::string summary) {
    using D = CpuTileStorageDescription;
    registry.resource<CpuTileStorage<T>, D, TileStorage>(tag, std::move(summary))
        .attribute("tileSize", &D::tileSize, "edge of a tile, borders included")
        .unit("pixels")
        .required()
        .atLeast(1)
        .attribute("channels", &D::channels, "values of a pixel")
        .required()
        .atLeast(1)
        .atMost(4)
        .attribute("capacity", &D::capacity, "number of tiles")
        .required()
        .atLeast(1)
        .atMost(kMostTiles)
        .check([](const D& d, Diagnostics& diagnostics) {
            const double bytes =
                1.0 * d.tileSize * d.tileSize * d.channels * d.capacity * sizeof(T);
            if (bytes > kMaxBytes)
                diagnostics.error("out-of-range", d.capacity.place,
                                  "so many tiles fit in no memory", "fewer, or smaller, tiles");
        })
        .build([](const D& d, BuildContext&) {
            auto storage = std::make_shared<CpuTileStorage<T>>(d.tileSize, d.channels, d.capacity);
            storage->setPlaces(d.tileSize.place, d.channels.place);
            return storage;
        });
}

struct ObjectTileStorageDescription : ElementDescription {
    Attr<int> capacity = 1;
};

void declareObjectTileStorage(Registry& registry) {
    using D = ObjectTileStorageDescription;
    registry
        .resource<ObjectTileStorage, D, TileStorage>(
            "objectTileStorage",
            "Tiles that are objects of a producer, such as graphs or meshes, in main memory.")
        .attribute("capacity", &D::capacity, "number of tiles")
        .required()
        .atLeast(1)
        .atMost(1 << 24)
        .build([](const D& d, BuildContext&) {
            auto storage = std::make_shared<ObjectTileStorage>(*d.capacity);
            storage->setPlaces(d.place, d.place);
            return storage;
        });
}

struct TileCacheDescription : ElementDescription {
    Ref<Scheduler> scheduler;
    Ref<TileStorage> storage;
};

void checkTileCache(const TileCacheDescription& d, Diagnostics& diagnostics) {
    if (d.children.empty() && !d.storage.given())
        diagnostics.error("missing-element", d.place, "the cache has no storage",
                          "a nested storage such as <gpuTileStorage>, or an attribute 'storage'");
    if (!d.children.empty() && d.storage.given())
        diagnostics.warning("unused-attribute", d.storage.place,
                            "the nested storage is used, not '" + d.storage.name + "'");
}

std::shared_ptr<TileCache> buildTileCache(const TileCacheDescription& d, BuildContext& context) {
    const auto storage =
        d.children.empty() ? d.storage.shared() : d.children.front().built<TileStorage>();
    if (!storage) return nullptr; // reported when it was built
    return std::make_shared<TileCache>(context.name(), storage, d.scheduler.shared());
}

void declareTileCache(Registry& registry) {
    using D = TileCacheDescription;
    registry
        .resource<TileCache, D>("tileCache",
                                "Keeps the tiles of producers; those in use are locked, the "
                                "others go when room is needed, the longest unused first.")
        .example(R"(<tileCache name="elevationCache" scheduler="defaultScheduler">
    <gpuTileStorage tileSize="101" nTiles="640" internalformat="RGB32F" format="RGB" type="FLOAT"/>
</tileCache>)")
        .attribute("scheduler", &D::scheduler, "what runs the tasks that produce tiles")
        .required()
        .attribute("storage", &D::storage, "where the tiles are, if it is not nested")
        .children<TileStorage>("where the tiles are", 0, 1)
        .check(checkTileCache)
        .build(buildTileCache);
}

} // namespace

void declareProducers(Registry& registry) {
    registry.nameInterface<TileStorage>("tile storage");
    registry.nameInterface<TileProducer>("producer");
    registry.nameInterface<TileLayer>("layer");
    declareGpuTileStorage(registry);
    declareCpuTileStorage<std::uint8_t>(registry, "cpuByteTileStorage",
                                        "Raster tiles of bytes in memory.");
    declareCpuTileStorage<float>(registry, "cpuFloatTileStorage",
                                 "Raster tiles of floats in memory.");
    declareObjectTileStorage(registry);
    declareTileCache(registry);
}

} // namespace terrane
