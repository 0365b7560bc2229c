// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/terrain_tasks.h"

#include "render/framebuffer.h"
#include "resource/registry.h"
#include "scene/bind_context.h"
#include "scene/draw_mesh.h"
#include "scene/frame_builder.h"
#include "scene/scene_manager.h"
#include "scene/scene_task.h"
#include "terrain/draw_terrain.h"
#include "terrain/terrain_node.h"
#include "terrain/tile_sampler.h"

namespace terrane {

namespace {

struct TerrainTaskDescription : ElementDescription {
    Attr<Target> terrain;
};

/// The node in whose frame the terrain lies: that of the target, or the owner of the method.
SceneNode& frameNode(const Attr<Target>& name, BindContext& context) {
    SceneNode* const node = name->node.empty() ? nullptr : context.findNode(name->node);
    return node ? *node : context.owner();
}

class BoundUpdateTerrain : public BoundTask {
public:
    BoundUpdateTerrain(TerrainNode& terrain, const SceneNode& node, SceneManager& scene)
        : terrain_(terrain)
        , node_(node)
        , scene_(scene) {}

    void emit(FrameBuilder&) override {
        update();
        if (terrain_.limitReached() && !told_) tellLimit();
    }

private:
    void update() {
        const auto& viewport = scene_.drawState().screen->state.viewport;
        terrain_.update({.localToCamera = node_.localToCamera,
                         .cameraToScreen = scene_.cameraToScreen,
                         .localToWorld = node_.localToWorld,
                         .viewportWidth = static_cast<double>(viewport.width)});
    }

    void tellLimit() {
        told_ = true;
        const TerrainNode::Parameters& p = terrain_.parameters();
        const std::string needed = std::to_string(p.maxQuads);
        scene_.resources().diagnostics().error(
            "too-many-quads", p.splitFactorPlace,
            "for this view the terrain would be divided into more than " + needed +
                " quads; it stays coarser than 'splitFactor' says",
            "a smaller splitFactor, or a lower maxLevel");
    }

    TerrainNode& terrain_;
    const SceneNode& node_;
    SceneManager& scene_;
    bool told_ = false;
};

/// Divides the quadtree of a terrain for the camera of now. The work is done while the graph of the
/// frame is built, since the tiles in it depend on the quads.
class UpdateTerrain : public SceneTask {
public:
    explicit UpdateTerrain(const TerrainTaskDescription& d)
        : terrain_(d.terrain) {}
    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        auto* const terrain = context.field<TerrainNode>(terrain_);
        if (!terrain) return nullptr;
        return std::make_unique<BoundUpdateTerrain>(*terrain, frameNode(terrain_, context),
                                                    context.scene());
    }

private:
    Attr<Target> terrain_;
};

class BoundUpdateTileSamplers : public BoundTask {
public:
    BoundUpdateTileSamplers(TerrainNode& terrain, std::vector<TileSampler*> samplers,
                            SceneManager& scene)
        : terrain_(terrain)
        , samplers_(std::move(samplers))
        , scene_(scene) {
        for (const TileSampler* sampler : samplers_) {
            if (sampler->parameters().storeInvisible) terrain_.setSplitInvisibleQuads(true);
            if (sampler->followsCamera()) terrain_.setSplitBelowCamera(true);
        }
    }

    void emit(FrameBuilder& frame) override {
        for (TileSampler* sampler : samplers_)
            sampler->update(terrain_, scene_, frame);
    }

private:
    TerrainNode& terrain_;
    std::vector<TileSampler*> samplers_;
    SceneManager& scene_;
};

/// Asks the producers for the tiles of a terrain's quads, for all samplers of the method's owner.
class UpdateTileSamplers : public SceneTask {
public:
    explicit UpdateTileSamplers(const TerrainTaskDescription& d)
        : terrain_(d.terrain) {}
    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        auto* const terrain = context.field<TerrainNode>(terrain_);
        if (!terrain) return nullptr;
        return std::make_unique<BoundUpdateTileSamplers>(
            *terrain, context.owner().fieldsOf<TileSampler>(), context.scene());
    }

private:
    Attr<Target> terrain_;
};

struct DrawTerrainDescription : ElementDescription {
    Attr<Target> field;
    Attr<Target> mesh;
    Attr<bool> culling = false;
};

class DrawTerrain : public SceneTask {
public:
    explicit DrawTerrain(const DrawTerrainDescription& d)
        : terrain_(d.field)
        , mesh_(d.mesh)
        , culling_(d.culling) {}

    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        const auto* const terrain = context.field<TerrainNode>(terrain_);
        const Mesh* const mesh = findMesh(mesh_, context);
        if (!terrain || !mesh) return nullptr;
        std::vector<const TileSampler*> samplers;
        for (const TileSampler* sampler : context.owner().fieldsOf<TileSampler>()) {
            if (sampler->parameters().storeLeaf) samplers.push_back(sampler);
        }
        return makeStep<DrawTerrainTask>(*terrain, *mesh, std::move(samplers), culling_,
                                         terrain_.place, context.scene());
    }

private:
    Attr<Target> terrain_;
    Attr<Target> mesh_;
    bool culling_;
};

constexpr const char* kTerrainSummary =
    "the terrain: by its key at a node, such as 'this.terrain', or its own name";

template <class T>
void declareUpdate(Registry& registry, const char* tag, const char* summary) {
    using D = TerrainTaskDescription;
    registry.resource<T, D, SceneTask>(tag, summary)
        .attribute("name", &D::terrain, kTerrainSummary)
        .required()
        .build([](const D& d, BuildContext&) { return std::make_shared<T>(d); });
}

} // namespace

void declareTerrainTasks(Registry& registry) {
    declareUpdate<UpdateTerrain>(
        registry, "updateTerrain",
        "Divides a terrain where the camera is near. Comes first in a frame.");
    declareUpdate<UpdateTileSamplers>(registry, "updateTileSamplers",
                                      "Has the tiles produced that the tile samplers of a "
                                      "terrain's node need. Comes after updateTerrain.");
    declareUpdate<UpdateTileSamplers>(registry, "updateUniform", "The same as updateTileSamplers.");

    using D = DrawTerrainDescription;
    registry
        .resource<DrawTerrain, D, SceneTask>(
            "drawTerrain", "Draws a mesh for each of the smallest squares of a terrain.")
        .example(R"(<drawTerrain name="this.terrain" mesh="this.grid" culling="true"/>)")
        .attribute("name", &D::field, kTerrainSummary)
        .required()
        .attribute("mesh", &D::mesh,
                   "the mesh of a quad: by its key at a node, such as 'this.grid', or 'm' for the "
                   "resource 'm.mesh'")
        .required()
        .attribute("culling", &D::culling, "leaves out what the camera can't see")
        .build([](const D& d, BuildContext&) { return std::make_shared<DrawTerrain>(d); });
}

} // namespace terrane
