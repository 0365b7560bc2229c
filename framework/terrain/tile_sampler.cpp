// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/tile_sampler.h"

#include "producer/gpu_tile_storage.h"
#include "resource/registry.h"
#include "scene/frame_builder.h"
#include "scene/scene_manager.h"

namespace terrane {

namespace {

TileId tileOf(const TerrainQuad& quad) {
    return {quad.level, quad.tx, quad.ty};
}

} // namespace

TileSampler::TileSampler(Parameters parameters)
    : parameters_(std::move(parameters)) {}

TileSampler::~TileSampler() {
    releaseAll();
}

bool TileSampler::needs(const TerrainQuad& quad) const {
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

void TileSampler::update(const TerrainNode& terrain, SceneManager& scene, FrameBuilder& frame) {
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
        if (quad.isAlive() && held.generation == quad.generation && needs(quad)) return false;
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
        if (!needs(quad) || held(quad)) continue;
        Tile* const tile = producer().getTile(tileOf(quad));
        refused_ |= tile == nullptr;
        if (!tile) continue;
        held_[quad.index] = {tile, quad.generation};
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

std::shared_ptr<TileSampler> build(const TileSamplerDescription& d, BuildContext& context) {
    if (!d.producer->isGpu()) {
        context.diagnostics().error("wrong-storage", d.producer.place,
                                    "the tiles of '" + d.producer.name + "' are not textures",
                                    "a producer whose cache has a gpuTileStorage");
        return nullptr;
    }
    return std::make_shared<TileSampler>(TileSampler::Parameters{.uniform = d.sampler,
                                                                 .producer = d.producer,
                                                                 .storeLeaf = d.storeLeaf,
                                                                 .storeParent = d.storeParent,
                                                                 .storeInvisible = d.storeInvisible,
                                                                 .place = d.place});
}

} // namespace

void declareTileSampler(Registry& registry) {
    using D = TileSamplerDescription;
    registry
        .resource<TileSampler, D>("tileSampler",
                                  "Gives the quads of a terrain tiles, and shaders access to them.")
        .attribute("sampler", &D::sampler, "the samplerTile variable of the shaders")
        .required()
        .attribute("producer", &D::producer, "who makes the tiles")
        .required()
        .attribute("terrains", &D::terrains, "terrains of a tile map")
        .planned()
        .onDemand()
        .attribute("storeLeaf", &D::storeLeaf, "leaves need tiles")
        .trueUnlessFalse()
        .attribute("storeParent", &D::storeParent, "divided quads need tiles")
        .trueUnlessFalse()
        .attribute("storeInvisible", &D::storeInvisible, "quads outside of the view need tiles")
        .trueUnlessFalse()
        .attribute("async", &D::async, "ancestors stand in until tiles are there")
        .planned()
        .attribute("mipmap", &D::mipmap, "with async, parts of ancestors may be drawn")
        .planned()
        .build(build);
}

} // namespace terrane
