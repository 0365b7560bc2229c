// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/draw_terrain.h"

#include "render/framebuffer.h"
#include "render/mesh.h"
#include "scene/scene_manager.h"
#include "terrain/terrain_node.h"
#include "terrain/tile_sampler.h"

namespace terrane {

DeformationUniforms::DeformationUniforms(Program& program)
    : blending(program.find("deformation.blending"))
    , localToScreen(program.find("deformation.localToScreen"))
    , radius(program.find("deformation.radius"))
    , localToWorld(program.find("deformation.localToWorld"))
    , offset(program.find("deformation.offset"))
    , camera(program.find("deformation.camera"))
    , tileToTangent(program.find("deformation.tileToTangent"))
    , screenQuadCorners(program.find("deformation.screenQuadCorners"))
    , screenQuadVerticals(program.find("deformation.screenQuadVerticals"))
    , screenQuadCornerNorms(program.find("deformation.screenQuadCornerNorms"))
    , tangentFrameToWorld(program.find("deformation.tangentFrameToWorld")) {}

void DeformationUniforms::set(const NodeUniforms& values) const {
    blending.set(values.blending);
    localToScreen.set(values.localToScreen);
    radius.set(values.radius);
    // A mat3 in shaders of spheres, a mat4 in those of cylinders.
    if (localToWorld.type().columns == 3)
        localToWorld.set(glm::mat3(values.localToWorld));
    else
        localToWorld.set(values.localToWorld);
}

void DeformationUniforms::set(const QuadUniforms& values) const {
    offset.set(values.offset);
    camera.set(values.camera);
    tileToTangent.set(values.tileToTangent);
    screenQuadCorners.set(values.screenQuadCorners);
    screenQuadVerticals.set(values.screenQuadVerticals);
    screenQuadCornerNorms.set(values.screenQuadCornerNorms);
    tangentFrameToWorld.set(values.tangentFrameToWorld);
}

QuadUniformNeeds DeformationUniforms::needs() const {
    return {.tileToTangent = tileToTangent.active(),
            .corners = screenQuadCorners.active() || screenQuadVerticals.active() ||
                       screenQuadCornerNorms.active(),
            .tangentFrameToWorld = tangentFrameToWorld.active()};
}

SamplerUniforms::SamplerUniforms(Program& program, const std::string& name)
    : pool(program.find(name + ".tilePool"))
    , coords(program.find(name + ".tileCoords"))
    , size(program.find(name + ".tileSize")) {}

void SamplerUniforms::set(const TileLocation& location) const {
    pool.set(*location.pool);
    coords.set(location.coords);
    size.set(location.size);
}

DrawTerrainTask::DrawTerrainTask(const TerrainNode& terrain, const Mesh& mesh,
                                 std::vector<const TileSampler*> samplers, bool culling,
                                 const Place& place, SceneManager& scene)
    : FrameTask("DrawTerrain")
    , terrain_(terrain)
    , mesh_(mesh)
    , samplers_(std::move(samplers))
    , culling_(culling)
    , place_(place)
    , scene_(scene) {}

void DrawTerrainTask::resolve(Program& program) {
    program_ = &program;
    deformationUniforms_ = DeformationUniforms(program);
    samplerUniforms_.clear();
    for (const TileSampler* sampler : samplers_)
        samplerUniforms_.emplace_back(program, sampler->parameters().uniform);
}

bool DrawTerrainTask::locateTiles(const TerrainQuad& quad) {
    const std::size_t before = tiles_.size();
    for (const TileSampler* sampler : samplers_) {
        tiles_.push_back(sampler->locate(terrain_, quad));
        if (tiles_.back().pool) continue;
        tiles_.resize(before);
        return false;
    }
    return true;
}

void DrawTerrainTask::gather() {
    quads_.clear();
    tiles_.clear();
    std::size_t missing = 0;
    const QuadUniformNeeds needs = deformationUniforms_.needs();
    terrain_.forEachLeaf([&](const TerrainQuad& quad) {
        if (culling_ && !quad.isVisible()) return;
        if (!locateTiles(quad)) {
            ++missing;
            return;
        }
        quads_.push_back(quadUniforms(terrain_.deformation(), terrain_.state(), quad, needs));
    });
    if (missing > 0 && quads_.empty() && !told_) {
        told_ = true;
        scene_.resources().diagnostics().error(
            "no-tiles", place_, "there are no tiles to draw the terrain with",
            "an updateTileSamplers of this terrain before it, and room in the caches");
    }
}

bool DrawTerrainTask::run() {
    Program* const program = scene_.currentProgram(mesh_, place_);
    if (!program) return false;
    if (program != program_) resolve(*program);
    gather();
    scene_.drawState().framebuffer->use();
    deformationUniforms_.set(nodeUniforms(terrain_.deformation(), terrain_.state()));
    for (std::size_t i = 0; i < quads_.size(); ++i) {
        deformationUniforms_.set(quads_[i]);
        for (std::size_t s = 0; s < samplers_.size(); ++s)
            samplerUniforms_[s].set(tiles_[i * samplers_.size() + s]);
        program->use();
        mesh_.draw();
    }
    return true;
}

} // namespace terrane
