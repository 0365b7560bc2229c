// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/tile_sampler.h"

#include "producer/gpu_tile_storage.h"
#include "resource/registry.h"
#include "scene/frame_builder.h"
#include "scene/scene_manager.h"
#include "terrain/tile_sampler_z.h"

#include <utility>

namespace terrane {

namespace {

TileId tileOf(const TerrainQuad& quad) {
    return {quad.level, quad.tx, quad.ty};
}

} // namespace

TileSampler::TileSampler(Parameters parameters)
    : parameters_(std::move(parameters))
    , producer_(parameters_.producer.shared()) {}

TileSampler::~TileSampler() {
    releaseAll();
}

bool TileSampler::needs(const TerrainNode&, const TerrainQuad& quad) const {
    const TileId id = tileOf(quad);
    bool needed = parameters_.storeLeaf;
    if (!parameters_.storeParent && !quad.isLeaf() && producer().hasChildren(id)) needed = false;
    if (!parameters_.storeInvisible && !quad.isVisible()) needed = false;
    return needed && producer().hasTile(id);
}

const Tile* TileSampler::held(const TerrainQuad& quad) const {
    if (quad.index >= static_cast<int>(held_.size())) return nullptr;
    const Held& held = held_[quad.index];
    return held.generation == quad.generation ? held.tile : nullptr;
}

bool TileSampler::wasMadeAgain(int index) {
    Held& held = held_[index];
    const Task::Date date = held.tile->done() ? held.tile->task()->completionDate() : 0;
    const Task::Date before = std::exchange(held.date, date);
    return before != 0 && before != date;
}

void TileSampler::update(TerrainNode& terrain, SceneManager& scene, FrameBuilder& frame) {
    if (terrain_ != &terrain) {
        releaseAll();
        terrain_ = &terrain;
        producer().setRootQuadSize(static_cast<float>(2 * terrain.parameters().size));
    }
    producer().update(scene);
    held_.resize(terrain.quads().capacity());
    release(terrain);
    acquire(terrain);
    reportShortage(scene.resources().diagnostics());
    require(frame);
}

void TileSampler::release(const TerrainNode& terrain) {
    const auto stale = [&](int index) {
        const TerrainQuad& quad = terrain.quads()[index];
        Held& held = held_[index];
        if (quad.isAlive() && held.generation == quad.generation && needs(terrain, quad))
            return false;
        producer().putTile(*held.tile);
        held.tile = nullptr;
        return true;
    };
    std::erase_if(heldQuads_, stale);
}

// Level by level, so that a full cache costs the finest tiles, not a whole region.
void TileSampler::acquire(const TerrainNode& terrain) {
    producer().cache().clearShortage();
    refused_ = false;
    queue_.clear();
    queue_.push_back(terrain.root().index);
    for (std::size_t next = 0; next < queue_.size(); ++next) {
        const TerrainQuad& quad = terrain.quads()[queue_[next]];
        if (!quad.isLeaf()) {
            for (int i = 0; i < QuadPool::kSiblings; ++i)
                queue_.push_back(quad.firstChild + i);
        }
        if (!needs(terrain, quad) || held(quad)) continue;
        Tile* const tile = producer().getTile(tileOf(quad));
        refused_ |= tile == nullptr;
        if (!tile) continue;
        held_[quad.index] = {.tile = tile, .generation = quad.generation};
        heldQuads_.push_back(quad.index);
    }
}

void TileSampler::releaseAll() {
    for (const int index : heldQuads_)
        producer().putTile(*held_[index].tile);
    heldQuads_.clear();
    held_.clear();
}

void TileSampler::require(FrameBuilder& frame) {
    for (const int index : heldQuads_) {
        const Tile& tile = *held_[index].tile;
        if (!tile.done()) frame.require(tile.task());
    }
}

void TileSampler::reportShortage(Diagnostics& diagnostics) {
    if (!refused_) return;
    const TileCache::Shortage shortage = producer().cache().shortage();
    // The next frames of a flight may need some more; nobody wants to hear of each.
    if (shortage.needed <= reportedNeed_ + reportedNeed_ / 4) return;
    reportedNeed_ = shortage.needed;
    diagnostics.error("cache-full", parameters_.place,
                      shortage.message + "; what is missing is drawn with coarser tiles",
                      "a larger storage, a smaller splitFactor, or a lower maxLevel");
}

TileLocation TileSampler::locate(const TerrainNode& terrain, const TerrainQuad& quad) const {
    if (&terrain != terrain_) return {}; // never updated for this one
    for (const TerrainQuad* q = &quad;; q = &terrain.quads()[q->parent]) {
        const Tile* const tile = held(*q);
        if (tile && tile->done()) {
            const auto& slot = tile->slot().as<GpuTileStorage::Slot>();
            return locateTile(tile->id(), tileOf(quad), producer().cache().storage().tileSize(),
                              producer().border(), *slot.texture(), slot.layer());
        }
        if (q->parent < 0) return {};
    }
}

namespace {

struct TileSamplerDescription : ElementDescription {
    Attr<std::string> sampler;
    Ref<TileProducer> producer;
    RefList<TerrainNode> terrains;
    Attr<bool> storeLeaf = true;
    Attr<bool> storeParent = true;
    Attr<bool> storeInvisible = true;
    Attr<bool> async = false;
    Attr<bool> mipmap = false;
};

using D = TileSamplerDescription;

TileSampler::Parameters parametersOf(const D& d) {
    return {.uniform = d.sampler,
            .producer = d.producer,
            .storeLeaf = d.storeLeaf,
            .storeParent = d.storeParent,
            .storeInvisible = d.storeInvisible,
            .place = d.place};
}

GpuTileStorage* storageOf(const D& d, Diagnostics& diagnostics) {
    auto* const storage = dynamic_cast<GpuTileStorage*>(&d.producer->cache().storage());
    if (!storage)
        diagnostics.error("wrong-storage", d.producer.place,
                          "the tiles of '" + d.producer.name + "' are not textures",
                          "a producer whose cache has a gpuTileStorage");
    return storage;
}

std::shared_ptr<TileSampler> build(const D& d, BuildContext& context) {
    if (!storageOf(d, context.diagnostics())) return nullptr;
    return std::make_shared<TileSampler>(parametersOf(d));
}

bool checkElevations(const D& d, const GpuTileStorage& storage, Diagnostics& diagnostics) {
    if (d.producer->border() != TileSamplerZ::kBorder) {
        diagnostics.error("wrong-producer", d.producer.place,
                          "the tiles of '" + d.producer.name + "' have a border of " +
                              std::to_string(d.producer->border()) + ", so they are no elevations",
                          "a producer of elevations, whose border is 2");
        return false;
    }
    const InternalFormatInfo& format = storage.format();
    const bool floats = format.kind == ChannelKind::real || format.kind == ChannelKind::normalized;
    if (format.channels >= 3 && floats) return true;
    const Place& place = storage.formatPlace() ? storage.formatPlace() : d.producer.place;
    diagnostics.error("wrong-format", place,
                      "elevations can't be read back from " + std::string(format.name),
                      "floats with three channels, such as RGB32F");
    return false;
}

std::shared_ptr<TileSamplerZ> buildZ(const D& d, BuildContext& context) {
    Diagnostics& diagnostics = context.diagnostics();
    GpuTileStorage* const storage = storageOf(d, diagnostics);
    if (!storage || !checkElevations(d, *storage, diagnostics)) return nullptr;
    const auto* const timing = context.manager().services().find<ReadbackTiming>();
    auto readback =
        ElevationReadback::of(*storage, TileSamplerZ::kBorder, context.service<ProgramBindings>(),
                              timing ? *timing : ReadbackTiming(), diagnostics);
    if (!readback) return nullptr;
    return std::make_shared<TileSamplerZ>(parametersOf(d), std::move(readback));
}

/// What both have.
template <class Builder>
auto&& addAttributes(Builder&& builder) {
    return builder
        .attribute("sampler", &D::sampler, "name of the uniform of type samplerTile in the shaders")
        .required()
        .attribute("producer", &D::producer, "who makes the tiles")
        .required()
        .attribute("terrains", &D::terrains, "terrains of a tile map")
        .planned()
        .onDemand()
        .attribute("storeLeaf", &D::storeLeaf, "whether the smallest squares need tiles")
        .trueUnlessFalse()
        .attribute("storeParent", &D::storeParent, "whether divided squares need tiles")
        .trueUnlessFalse()
        .attribute("storeInvisible", &D::storeInvisible,
                   "whether squares outside of the view need tiles")
        .trueUnlessFalse()
        .attribute("async", &D::async, "coarser tiles stand in until tiles are there")
        .planned();
}

} // namespace

void declareTileSampler(Registry& registry) {
    addAttributes(
        registry
            .resource<TileSampler, D>(
                "tileSampler", "Gives the squares of a terrain their tiles of a producer, and "
                               "shaders access to them. Stands in the node of the terrain.")
            .example(
                R"(<tileSampler name="normalSampler" sampler="normalSampler" producer="normals"/>)"))
        .attribute("mipmap", &D::mipmap, "with 'async': parts of coarser tiles may be drawn")
        .planned()
        .build(build);
    addAttributes(registry.resource<TileSamplerZ, D>(
                      "tileSamplerZ",
                      "A tileSampler for elevations that also reads them back: the camera stays "
                      "above the ground, and quads that can't be seen are not drawn."))
        .build(buildZ);
}

} // namespace terrane
