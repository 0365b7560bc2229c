// SPDX-License-Identifier: BSD-3-Clause
#include "archive_folder.h"

#include "resource/declaration.h"

#include <doctest/doctest.h>

using namespace terrane;

TEST_CASE("every element of the original is known, built or not") {
    // Ork reference 2.1; terrain reference 1.0; graph and river reference 1.1; those of examples.
    const char* const tags[] = {"texture1D",
                                "texture1DArray",
                                "texture2D",
                                "texture2DArray",
                                "texture3D",
                                "textureCube",
                                "textureCubeArray",
                                "textureRectangle",
                                "module",
                                "program",
                                "mesh",
                                "font",
                                "node",
                                "multithreadScheduler",
                                "sequence",
                                "setTarget",
                                "showInfo",
                                "showLog",
                                "foreach",
                                "setProgram",
                                "setState",
                                "setTransforms",
                                "callMethod",
                                "drawMesh",
                                "gpuTileStorage",
                                "cpuByteTileStorage",
                                "cpuFloatTileStorage",
                                "objectTileStorage",
                                "tileCache",
                                "terrainNode",
                                "tileSampler",
                                "tileSamplerZ",
                                "updateTerrain",
                                "updateTileSamplers",
                                "drawTerrain",
                                "basicViewHandler",
                                "eventRecorder",
                                "mousePositionHandler",
                                "drawTweakBar",
                                "tweakBarManager",
                                "tweakBar",
                                "tweakScene",
                                "tweakView",
                                "particleStorage",
                                "particleProducer",
                                "lifeCycleParticleLayer",
                                "randomParticleLayer",
                                "screenParticleLayer",
                                "terrainParticleLayer",
                                "worldParticleLayer",
                                "residualProducer",
                                "elevationProducer",
                                "cpuElevationProducer",
                                "normalProducer",
                                "orthoCpuProducer",
                                "orthoGpuProducer",
                                "orthoProducer",
                                "emptyOrthoLayer",
                                "textureLayer",
                                "graphProducer",
                                "basicGraphFactory",
                                "lazyGraphFactory",
                                "lineOrthoLayer",
                                "maskOrthoLayer",
                                "roadOrthoLayer",
                                "waterOrthoLayer",
                                "fieldsOrthoLayer",
                                "forestOrthoLayer",
                                "roadElevationLayer",
                                "waterElevationLayer",
                                "hydroGraphFactory",
                                "lazyHydroGraphFactory",
                                "hydroFlowProducer",
                                "waveTile",
                                "perlinWaveTile",
                                "animatedPerlinWaveTile",
                                "updateRivers",
                                "drawRivers",
                                "tweakRivers",
                                "editResidualProducer",
                                "editElevationProducer",
                                "editOrthoCpuProducer",
                                "editOrthoProducer",
                                "editGraphOrthoLayer",
                                "editHydroGraphOrthoLayer",
                                "tweakDem",
                                "tweakOrtho",
                                "tweakGraphLayer",
                                "tweakHydroGraphLayer",
                                "drawOcean",
                                "drawOceanFFT",
                                "plants",
                                "drawPlants",
                                "drawPlantsShadow",
                                "lccProducer",
                                "helloworld",
                                "prolandDemo",
                                "drawTerrainBox",
                                "debugOrthoLayer",
                                "contourProducer"};
    for (const char* tag : tags) {
        CAPTURE(tag);
        CHECK(standardRegistry().find(tag) != nullptr);
    }
}

TEST_CASE("what is built has replaced what was planned") {
    for (const char* tag : {"texture2D", "module", "program", "mesh", "node", "sequence",
                            "multithreadScheduler", "tileCache", "terrainNode", "tileSampler",
                            "tileSamplerZ", "drawTerrain", "elevationProducer", "normalProducer"}) {
        CAPTURE(tag);
        const ElementDeclaration* const found = standardRegistry().find(tag);
        REQUIRE(found);
        CHECK(!found->planned);
    }
}
