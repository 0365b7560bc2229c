// SPDX-License-Identifier: BSD-3-Clause
#include "app/register_types.h"

#include "app/planned_types.h"
#include "app/player_element.h"
#include "producer/declare.h"
#include "render/font.h"
#include "render/mesh_resource.h"
#include "render/module_resource.h"
#include "render/program_resource.h"
#include "render/texture_resource.h"
#include "scene/control_tasks.h"
#include "scene/draw_mesh.h"
#include "scene/scene_node.h"
#include "scene/set_program.h"
#include "scene/set_state.h"
#include "scene/set_target.h"
#include "scene/set_transforms.h"
#include "scene/show_info.h"
#include "scene/show_log.h"
#include "task/declare.h"
#include "terrain/terrain_resource.h"
#include "terrain/terrain_tasks.h"
#include "terrain/tile_sampler.h"

namespace terrane {

void registerStandardTypes(Registry& registry) {
    declarePlannedTypes(registry); // first: what is built replaces it
    declareScheduler(registry);
    declareTextures(registry);
    declareModule(registry);
    declareProgram(registry);
    declareMesh(registry);
    declareSceneNode(registry);
    declareControlTasks(registry);
    declareDrawMesh(registry);
    declareSetProgram(registry);
    declareSetState(registry);
    declareSetTarget(registry);
    declareSetTransforms(registry);
    declareFont(registry);
    declareShowInfo(registry);
    declareShowLog(registry);
    declareProducers(registry);
    declareTerrainNode(registry);
    declareTileSampler(registry);
    declareTerrainTasks(registry);
    declarePlayerElements(registry);
}

} // namespace terrane
