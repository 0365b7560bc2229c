// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/planned_plugins.h"

#include "producer/tile_layer.h"
#include "producer/tile_producer.h"
#include "resource/registry.h"
#include "scene/scene_task.h"

namespace terrane {

namespace {

// Terrain reference 1.7, 1.8.
void declarePlannedTerrain(Registry& registry) {
    registry.planned<TileProducer>("orthoCpuProducer", "Colours from a file.");
    registry.planned<TileProducer>("orthoGpuProducer", "Colours on the GPU.");
    registry.planned<TileProducer>("orthoProducer", "Colours for drawing.");
    registry.planned<TileLayer>("emptyOrthoLayer", "A layer that changes nothing.");
    registry.planned<TileLayer>("textureLayer", "Draws the tiles of another producer.");
}

// Graph and river reference 1.1.
void declarePlannedGraph(Registry& registry) {
    registry.planned<TileProducer>("graphProducer", "Roads, rivers and other curves and areas.");
    registry.planned<>("basicGraphFactory", "Graphs that are read as a whole.");
    registry.planned<>("lazyGraphFactory", "Graphs that are read in parts.");
    for (const char* tag : {"lineOrthoLayer", "maskOrthoLayer", "roadOrthoLayer", "waterOrthoLayer",
                            "fieldsOrthoLayer", "forestOrthoLayer"})
        registry.planned<TileLayer>(tag, "Draws curves or areas of graphs into colours.");
    for (const char* tag : {"roadElevationLayer", "waterElevationLayer"})
        registry.planned<TileLayer>(tag, "Shapes the ground to fit curves or areas of graphs.");
}

void declarePlannedRiver(Registry& registry) {
    registry.planned<>("hydroGraphFactory", "Graphs of rivers that are read as a whole.");
    registry.planned<>("lazyHydroGraphFactory", "Graphs of rivers that are read in parts.");
    registry.planned<TileProducer>("hydroFlowProducer", "The flow of rivers.");
    for (const char* tag : {"waveTile", "perlinWaveTile", "animatedPerlinWaveTile"})
        registry.planned<>(tag, "A pattern of waves.");
    registry.planned<SceneTask>("updateRivers", "Moves the waves of rivers.");
    registry.planned<SceneTask>("drawRivers", "Draws the waves of rivers.");
}

void declarePlannedEditing(Registry& registry) {
    for (const char* tag : {"editResidualProducer", "editElevationProducer", "editOrthoCpuProducer",
                            "editOrthoProducer"})
        registry.planned<TileProducer>(tag, "Tiles that can be painted on.");
    for (const char* tag : {"editGraphOrthoLayer", "editHydroGraphOrthoLayer"})
        registry.planned<TileLayer>(tag, "Curves that can be moved with the mouse.");
    for (const char* tag :
         {"tweakDem", "tweakOrtho", "tweakGraphLayer", "tweakHydroGraphLayer", "tweakRivers"})
        registry.planned<>(tag, "A panel for an editor.");
}

// Graph and river reference 7.
void declarePlannedOceanAndForest(Registry& registry) {
    for (const char* tag : {"drawOcean", "drawOceanFFT"})
        registry.planned<SceneTask>(tag, "Draws the ocean.");
    registry.planned<>("plants", "Plants for a landscape.");
    registry.planned<SceneTask>("drawPlants", "Draws plants.");
    registry.planned<SceneTask>("drawPlantsShadow", "Draws the shadows of plants.");
    registry.planned<TileProducer>("lccProducer", "What covers the ground.");
}

} // namespace

void declarePlannedPlugins(Registry& registry) {
    registry.chapter("Planned");
    declarePlannedTerrain(registry);
    declarePlannedGraph(registry);
    declarePlannedRiver(registry);
    declarePlannedEditing(registry);
    declarePlannedOceanAndForest(registry);
}

} // namespace terrane
