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
    registry.chapter("The player", "How an archive is played, and what runs its tasks.");
    declarePlayerElements(registry);
    declareScheduler(registry);
    registry.chapter("Scene", "The tree of things in the world, and what each has and does.");
    declareSceneNode(registry);
    registry.chapter("Methods", "What happens in a frame: tasks, and tasks made of tasks. A "
                                "`<method>` of a node runs one of them.");
    declareControlTasks(registry);
    declareSetProgram(registry);
    declareSetTransforms(registry);
    declareSetState(registry);
    declareSetTarget(registry);
    declareDrawMesh(registry);
    declareShowInfo(registry);
    declareShowLog(registry);
    registry.chapter("Shaders", "GLSL, and the values that its uniforms start with.");
    declareModule(registry);
    declareProgram(registry);
    registry.chapter("Textures",
                     "Pictures and other arrays of pixels, from files or to draw into.");
    declareTextures(registry);
    registry.chapter("Meshes and fonts", "What is drawn with shaders and textures.");
    declareMesh(registry);
    declareFont(registry);
    registry.chapter("Tiles",
                     "Where the tiles of producers are kept. A producer has a cache, and a "
                     "cache has a storage with room for so many tiles.");
    declareProducers(registry);
    registry.chapter("Terrain", "Ground that is divided where the camera is near, and the methods "
                                "that update and draw it.");
    declareTerrainNode(registry);
    declareTileSampler(registry);
    declareTerrainTasks(registry);
}

} // namespace terrane
