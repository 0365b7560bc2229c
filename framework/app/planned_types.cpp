// SPDX-License-Identifier: BSD-3-Clause
#include "app/planned_types.h"

#include "producer/tile_layer.h"
#include "producer/tile_producer.h"
#include "resource/registry.h"
#include "scene/scene_task.h"

namespace terrane {

namespace {

// Terrain reference 6.
void declarePlannedDrawing(Registry& registry) {
    registry.planned<SceneTask>("showTexture", "Draws textures on the picture, to look at them.");
    registry.planned<SceneTask>("drawTweakBar", "Draws the panels.");
    registry.planned<SceneTask>("drawTerrainBox", "Draws the bounding boxes of quads.");
}

// Terrain reference 1.9.
void declarePlannedHandlers(Registry& registry) {
    registry.planned<>("basicViewHandler", "Moves the camera with mouse and keys.");
    registry.planned<>("eventRecorder", "Records events and plays them back.");
    registry.planned<>("mousePositionHandler", "Tells what is under the mouse.");
    registry.planned<>("tweakBarManager", "The panels, and which of them are open.");
    registry.planned<>("tweakBar", "A panel of switches and values.");
    registry.planned<>("tweakScene", "A panel that shows the scene.");
    registry.planned<>("tweakView", "A panel of views to go to.");
    registry.planned<>("helloworld", "The window of examples of the original.");
    registry.planned<>("prolandDemo", "The window of the original's demo.");
}

// Terrain reference 1.10.
void declarePlannedParticles(Registry& registry) {
    registry.planned<>("particleStorage", "Room for particles.");
    registry.planned<>("particleProducer", "Makes, moves and removes particles.");
    registry.planned<>("lifeCycleParticleLayer", "Lets particles fade in and out.");
    registry.planned<>("randomParticleLayer", "Gives each particle random numbers.");
    registry.planned<>("screenParticleLayer", "Keeps particles evenly spread over the picture.");
    registry.planned<>("terrainParticleLayer", "Moves particles with the flow of rivers.");
    registry.planned<>("worldParticleLayer", "Gives particles a place in the world.");
}

} // namespace

void declarePlannedTypes(Registry& registry) {
    registry.chapter("Planned",
                     "Types that archives of the original use and that are not built yet. "
                     "An archive may have them: there is a warning, and it is played "
                     "without them.");
    declarePlannedDrawing(registry);
    declarePlannedHandlers(registry);
    declarePlannedParticles(registry);
    registry.planned<TileLayer>("debugOrthoLayer", "Writes the number of each tile's slot on it.");
    registry.planned<TileProducer>("contourProducer", "Contour lines of an elevation producer.");
}

} // namespace terrane
