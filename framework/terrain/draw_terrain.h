// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/source.h"
#include "render/program.h"
#include "scene/scene_task.h"
#include "terrain/deformation_uniforms.h"
#include "terrain/tile_location.h"

#include <vector>

namespace terrane {

class Mesh;
class SceneManager;
class TerrainNode;
class TileSampler;

/// The uniforms of the struct `deformation`, as a program has them (terrain reference 2.1).
struct DeformationUniforms {
    explicit DeformationUniforms(Program& program);
    DeformationUniforms() = default;
    void set(const NodeUniforms& values) const;
    void set(const QuadUniforms& values) const;
    /// What the program has at the moment.
    QuadUniformNeeds needs() const;

    UniformHandle blending, localToScreen, radius, localToWorld;
    UniformHandle offset, camera, tileToTangent, screenQuadCorners, screenQuadVerticals,
        screenQuadCornerNorms, tangentFrameToWorld;
};

/// The uniforms of one `samplerTile`.
struct SamplerUniforms {
    SamplerUniforms(Program& program, const std::string& name);
    void set(const TileLocation& location) const;

    UniformHandle pool, coords, size;
};

/// Draws the leaves of a terrain, front to back: first gathers what the shaders need of each quad
/// into plain arrays, then draws. A quad without any tile of a sampler is left out.
class DrawTerrainTask : public FrameTask {
public:
    /// All of them must outlive the task.
    DrawTerrainTask(const TerrainNode& terrain, const Mesh& mesh,
                    std::vector<const TileSampler*> samplers, bool culling, const Place& place,
                    SceneManager& scene);

    bool run() override;

private:
    void resolve(Program& program);
    void gather();
    bool locateTiles(const TerrainQuad& quad);

    const TerrainNode& terrain_;
    const Mesh& mesh_;
    const std::vector<const TileSampler*> samplers_;
    const bool culling_;
    const Place place_;
    SceneManager& scene_;

    Program* program_ = nullptr; ///< whose uniforms the handles are
    DeformationUniforms deformationUniforms_;
    std::vector<SamplerUniforms> samplerUniforms_;

    bool told_ = false; ///< that there are no tiles
    std::vector<QuadUniforms> quads_;
    std::vector<TileLocation> tiles_; ///< one for each quad and sampler
};

} // namespace terrane
