// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/tile_sampler_z.h"

#include "scene/frame_builder.h"
#include "scene/scene_manager.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

namespace terrane {

TileSamplerZ::TileSamplerZ(Parameters parameters, std::shared_ptr<ElevationReadback> readback)
    : TileSampler(std::move(parameters))
    , readback_(std::move(readback)) {}

TileSamplerZ::~TileSamplerZ() {
    readback_->forget(point_);
}

bool TileSamplerZ::needs(const TerrainNode& terrain, const TerrainQuad& quad) const {
    if (TileSampler::needs(terrain, quad)) return true;
    if (quad.doubtful && (held(quad) || isChosen(quad))) return true;
    const bool below = terrain.isBelowCamera(quad) || terrain.isSoonBelowCamera(quad);
    return below && producer().hasTile({quad.level, quad.tx, quad.ty});
}

void TileSamplerZ::update(TerrainNode& terrain, SceneManager& scene, FrameBuilder& frame) {
    chooseDoubtful(terrain);
    TileSampler::update(terrain, scene, frame);
    updatedIn_ = scene.frameNumber();
    readback_->beginFrame(scene.frameNumber());
    measureQuads(terrain);
    followGround(terrain, scene.frameNumber());
    if (readback_->isAsked()) frame.require(readback_->task());
}

// The nearest ones first.
void TileSamplerZ::chooseDoubtful(const TerrainNode& terrain) {
    chosenCount_ = 0;
    doubting_ = false;
    // Tiles that are drawn may need some of the room.
    const int room = producer().cache().room() / 2;
    const int most = std::min(room, static_cast<int>(chosen_.size()));
    terrain.forEachLeaf([&](const TerrainQuad& quad) {
        if (!quad.doubtful || !producer().hasTile({quad.level, quad.tx, quad.ty})) return;
        const bool has = this->terrain() == &terrain && held(quad);
        if (!has && chosenCount_ == most) return;
        doubting_ = true;
        if (!has) chosen_[chosenCount_++] = quad.index;
    });
}

bool TileSamplerZ::isChosen(const TerrainQuad& quad) const {
    const auto end = chosen_.begin() + chosenCount_;
    return std::find(chosen_.begin(), end, quad.index) != end;
}

// Tiles that are not held may be made differently, too, when they are needed again.
void TileSamplerZ::forgetUnheld(TerrainNode& terrain) {
    for (int i = 0; i < terrain.quads().capacity(); ++i) {
        const TerrainQuad& quad = terrain.quads()[i];
        if (quad.isAlive() && quad.measured && !held(quad)) terrain.forgetElevations(i);
    }
}

void TileSamplerZ::measureQuads(TerrainNode& terrain) {
    const std::uint64_t invalidations = producer().cache().invalidations();
    bool changed = std::exchange(invalidations_, invalidations) != invalidations;
    for (const int index : heldQuads())
        changed |= wasMadeAgain(index);
    if (changed) forgetUnheld(terrain);
    for (const int index : heldQuads()) {
        const Tile* const tile = held(terrain.quads()[index]);
        const ElevationReadback::Range* const range =
            tile->done() ? readback_->range(*tile) : nullptr;
        if (range)
            terrain.setElevations(index, range->zmin, range->zmax);
        else
            terrain.forgetElevations(index);
    }
}

void TileSamplerZ::takeSample(TerrainNode& terrain, std::uint64_t frame) {
    if (!std::exchange(point_.arrived, false)) return;
    // Of a camera that has jumped, somebody may have a newer sample meanwhile.
    const auto& known = terrain.groundSample();
    const glm::dvec2 camera(terrain.state().localCamera);
    const glm::dvec2 next = moving_ ? camera + (camera - camera_) : camera;
    constexpr double kAsNear = 1; // metres
    if (known && terrain.state().cameraIsLocal &&
        glm::distance(point_.place, next) > glm::distance(known->place, next) + kAsNear)
        return;
    terrain.setGroundSample({point_.elevation, point_.place, frame});
}

void TileSamplerZ::followGround(TerrainNode& terrain, std::uint64_t frame) {
    waiting_ = false;
    takeSample(terrain, frame);
    terrain.setCameraSoon(std::nullopt);
    if (!terrain.state().cameraIsLocal) {
        moving_ = false;
        return;
    }
    const glm::dvec2 place = whereCameraWillBe(terrain.state());
    terrain.setCameraSoon(place);
    if (!terrain.isSoonBelowCamera(terrain.root())) return;
    const TerrainQuad* const quad = finestQuad(terrain, place);
    if (!quad) return;
    const Tile& tile = *held(*quad);
    const Sample sample{&tile, tile.id(), tile.task()->completionDate(),
                        texelAt((place - glm::dvec2(quad->ox, quad->oy)) / quad->l,
                                tile.cache().storage().tileSize(), producer().border())};
    // What is nearer than this is the same place: heights move the camera a little sideways, which
    // must come to an end.
    constexpr double kSamePlace = 1.0 / 32; // texels
    const bool same = sample.tile == sample_.tile && sample.id == sample_.id &&
                      sample.date == sample_.date &&
                      glm::distance(sample.texel, sample_.texel) < kSamePlace;
    if (same) return;
    waiting_ = !readback_->ask(point_, tile, sample.texel, place);
    if (!waiting_) sample_ = sample;
}

// The answer is used by the frame after the one in which it arrives.
glm::dvec2 TileSamplerZ::whereCameraWillBe(const TerrainState& state) {
    constexpr int kFrames = PixelReadback::kLatency + 1;
    const glm::dvec2 camera(state.localCamera);
    const glm::dvec2 before = std::exchange(camera_, camera);
    const glm::dvec2 step = moving_ ? camera - before : glm::dvec2(0);
    const glm::dvec2 stepBefore = std::exchange(step_, step);
    moving_ = true;
    // After a jump nobody knows where it goes.
    const bool steady = glm::distance(step, stepBefore) <= 0.5 * glm::length(step);
    return steady ? camera + static_cast<double>(kFrames) * step : camera;
}

// The finest one there with a tile.
const TerrainQuad* TileSamplerZ::finestQuad(const TerrainNode& terrain,
                                            const glm::dvec2& local) const {
    const TerrainQuad* quad = &terrain.leafAt(local);
    while (true) {
        const Tile* const tile = held(*quad);
        if (tile && tile->done()) return quad;
        if (quad->parent < 0) return nullptr;
        quad = &terrain.quads()[quad->parent];
    }
}

} // namespace terrane
