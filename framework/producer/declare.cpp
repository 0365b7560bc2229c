// SPDX-License-Identifier: BSD-3-Clause
#include "producer/declare.h"

#include "producer/cpu_tile_storage.h"
#include "producer/gpu_tile_storage.h"
#include "producer/object_tile_storage.h"
#include "producer/tile_cache.h"
#include "producer/tile_producer.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"
#include "task/scheduler.h"

namespace terrane {

namespace {

const Words<MinFilter> kMinFilterWords{{"NEAREST", MinFilter::nearest},
                                       {"LINEAR", MinFilter::linear},
                                       {"NEAREST_MIPMAP_NEAREST", MinFilter::nearestMipmapNearest},
                                       {"NEAREST_MIPMAP_LINEAR", MinFilter::nearestMipmapLinear},
                                       {"LINEAR_MIPMAP_NEAREST", MinFilter::linearMipmapNearest},
                                       {"LINEAR_MIPMAP_LINEAR", MinFilter::linearMipmapLinear}};
const Words<MagFilter> kMagFilterWords{{"NEAREST", MagFilter::nearest},
                                       {"LINEAR", MagFilter::linear}};

struct GpuTileStorageDescription : ElementDescription {
    Attr<int> tileSize = 1;
    Attr<int> nTiles = 1;
    Attr<InternalFormat> internalformat = InternalFormat::rgba8;
    Attr<TransferFormat> format = TransferFormat::rgba;
    Attr<TransferType> type = TransferType::u8;
    Attr<MinFilter> min = MinFilter::nearest;
    Attr<MagFilter> mag = MagFilter::linear;
    Attr<float> minLod = -1000;
    Attr<float> maxLod = 1000;
    Attr<float> minLevel = 0;
    Attr<float> maxLevel = 1000;
    Attr<std::string> swizzle = "rgba";
    Attr<float> anisotropy = 1;
    Attr<bool> tileMap = false;
};

constexpr std::string_view kSwizzleLetters = "rgba01";

Swizzle swizzleOf(char letter) {
    constexpr Swizzle values[] = {Swizzle::red,   Swizzle::green, Swizzle::blue,
                                  Swizzle::alpha, Swizzle::zero,  Swizzle::one};
    return values[kSwizzleLetters.find(letter)];
}

void checkSwizzle(const GpuTileStorageDescription& d, Diagnostics& diagnostics) {
    const std::string& text = *d.swizzle;
    if (text.size() == 4 && text.find_first_not_of(kSwizzleLetters) == std::string::npos) return;
    diagnostics.error("wrong-kind", d.swizzle.place, "'" + text + "' is no swizzle",
                      "four of the letters r, g, b, a, 0, 1, such as 'rgba'");
}

SamplingParameters samplingOf(const GpuTileStorageDescription& d) {
    SamplingParameters s{.min = d.min,
                         .mag = d.mag,
                         .minLod = d.minLod,
                         .maxLod = d.maxLod,
                         .minLevel = static_cast<int>(*d.minLevel),
                         .maxLevel = static_cast<int>(*d.maxLevel),
                         .anisotropy = d.anisotropy};
    for (std::size_t i = 0; i < s.swizzle.size(); ++i)
        s.swizzle[i] = swizzleOf((*d.swizzle)[i]);
    return s;
}

std::shared_ptr<GpuTileStorage> buildGpuTileStorage(const GpuTileStorageDescription& d,
                                                    BuildContext& context) {
    const GlContext& gl = context.service<GlContext>();
    const GpuTileStorage::Description description{.tileSize = d.tileSize,
                                                  .tiles = d.nTiles,
                                                  .format = d.internalformat,
                                                  .transfer = {d.format, d.type},
                                                  .sampling = samplingOf(d),
                                                  .tileMap = d.tileMap};
    const int maxLayers = gl.maxArrayLayers();
    const std::string problem = GpuTileStorage::problem(gl, description, maxLayers);
    if (!problem.empty()) {
        context.diagnostics().error("bad-texture", d.place, problem);
        return nullptr;
    }
    auto storage = std::make_shared<GpuTileStorage>(gl, description, maxLayers);
    storage->setPlaces(d.tileSize.place, d.internalformat.place);
    return storage;
}

void declareGpuTileStorage(Registry& registry) {
    using D = GpuTileStorageDescription;
    registry
        .resource<GpuTileStorage, D, TileStorage>(
            "gpuTileStorage", "Raster tiles on the GPU, as layers of 2D array textures.")
        .attribute("tileSize", &D::tileSize, "edge of a tile, borders included")
        .unit("pixels")
        .required()
        .atLeast(1)
        .attribute("nTiles", &D::nTiles, "number of tiles")
        .required()
        .atLeast(1)
        .attribute("internalformat", &D::internalformat, "how pixels are stored",
                   internalFormatWords())
        .required()
        .attribute("format", &D::format, "channels of uploaded pixels", transferFormatWords())
        .required()
        .attribute("type", &D::type, "type of a channel of uploaded pixels", transferTypeWords())
        .required()
        .attribute("min", &D::min,
                   "filter for tiles that are drawn smaller; the mipmap ones keep mipmaps",
                   kMinFilterWords)
        .attribute("mag", &D::mag, "filter for tiles that are drawn larger", kMagFilterWords)
        .attribute("minLod", &D::minLod, "lower limit of the level of detail")
        .alias("minLOD")
        .attribute("maxLod", &D::maxLod, "upper limit of the level of detail")
        .alias("maxLOD")
        .attribute("minLevel", &D::minLevel, "first mipmap level in use")
        .atLeast(0)
        .attribute("maxLevel", &D::maxLevel, "last mipmap level in use")
        .atLeast(0)
        .atMost(1000)
        .attribute("swizzle", &D::swizzle,
                   "what shaders read as red, green, blue and alpha: four of rgba01")
        .attribute("anisotropy", &D::anisotropy, "maximum anisotropy of the filter")
        .atLeast(1)
        .attribute("tileMap", &D::tileMap,
                   "keep the map that the shader function textureQuadtree needs; all tiles must "
                   "fit in one array texture")
        .check(checkSwizzle)
        .build(buildGpuTileStorage);
}

struct CpuTileStorageDescription : ElementDescription {
    Attr<int> tileSize = 1;
    Attr<int> channels = 1;
    Attr<int> capacity = 1;
};

// More than any machine's memory: a slip of the pen.
constexpr double kMaxBytes = 1e12;

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
        .check([](const D& d, Diagnostics& diagnostics) {
            const double bytes =
                1.0 * d.tileSize * d.tileSize * d.channels * d.capacity * sizeof(T);
            if (bytes > kMaxBytes)
                diagnostics.error("out-of-range", d.place, "so many tiles fit in no memory",
                                  "fewer, or smaller, tiles");
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
        .resource<ObjectTileStorage, D, TileStorage>("objectTileStorage",
                                                     "Tiles that are graphs, meshes, lists...")
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
        d.children.empty() ? share(d.storage) : d.children.front().built<TileStorage>();
    if (!storage) return nullptr; // reported when it was built
    return std::make_shared<TileCache>(context.name(), storage, share(d.scheduler));
}

void declareTileCache(Registry& registry) {
    using D = TileCacheDescription;
    registry
        .resource<TileCache, D>("tileCache",
                                "Keeps the tiles of producers; those in use are locked, the "
                                "others go when room is needed, the longest unused first.")
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
