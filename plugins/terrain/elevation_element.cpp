// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/declare.h"
#include "plugins/terrain/elevation_producer.h"
#include "plugins/terrain/storage_checks.h"
#include "producer/cpu_tile_storage.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"

namespace terrane {

namespace {

struct ElevationDescription : ElementDescription {
    Ref<TileCache> cache;
    Ref<TileProducer> residuals;
    Ref<Program> upsampleProg{"upsampleShader;"};
    Ref<Program> blendProg{"blendShader;"};
    Attr<int> gridSize = 24;
    Attr<std::vector<float>> noise;
    Attr<bool> flip = false;
    Attr<int> face = 0;
};

// n + 5, the residuals' too.
constexpr int kRest = 5;

bool checkFormat(const GpuTileStorage& storage, const Place& reference, Diagnostics& diagnostics) {
    const InternalFormatInfo& format = storage.format();
    if (format.kind == ChannelKind::real && format.channels >= 2) {
        // The coarse elevations of a tile are made from its parent's third channel.
        if (format.channels == 2)
            diagnostics.warning("wrong-format", storage.formatPlace(),
                                "elevation tiles without a third channel blend to sea level",
                                "three channels, such as RGB32F");
        return true;
    }
    reportFormat(storage, reference, "elevations can't be stored as " + std::string(format.name),
                 "floats with three channels, such as RGB32F", diagnostics);
    return false;
}

bool checkTileSize(const ElevationDescription& d, const GpuTileStorage& storage,
                   Diagnostics& diagnostics) {
    const int n = storage.tileSize() - kRest;
    // A tile is two parent halves wide.
    const int step = d.gridSize % 2 == 0 ? *d.gridSize : 2 * d.gridSize;
    if (n > 0 && n % step == 0) return true;
    reportTileSize(storage, d.cache.place,
                   "elevations with gridSize " + std::to_string(*d.gridSize),
                   multiplesNear(step, kRest, storage.tileSize()), diagnostics);
    return false;
}

// Terrain reference 1.7: the last character of the name, if it is a face.
int faceOf(const ElevationDescription& d, const std::string& name) {
    if (d.face.given) return d.face;
    const char last = name.empty() ? '0' : name.back();
    return last >= '1' && last <= '6' ? last - '0' : 0;
}

bool adoptLayers(const ElevationDescription& d, BuildContext& context,
                 ElevationProducer::Parameters& parameters, const std::string& target) {
    const bool any = std::any_of(d.children.begin(), d.children.end(),
                                 [](const Child& child) { return child.resource != nullptr; });
    if (!any) return true;
    context.load(d.blendProg);
    parameters.blend = d.blendProg.shared();
    parameters.blendTarget = context.load<Texture>(target + "-1", d.place).shared();
    return parameters.blend && parameters.blendTarget;
}

std::shared_ptr<ElevationProducer> buildElevations(const ElevationDescription& d,
                                                   BuildContext& context) {
    Diagnostics& diagnostics = context.diagnostics();
    const GpuTileStorage* const storage = gpuStorage(d.cache, diagnostics);
    if (!storage) return nullptr;
    const int size = storage->tileSize();
    const bool formatIsRight = checkFormat(*storage, d.cache.place, diagnostics);
    // First, since a file leaves no choice.
    if (d.residuals &&
        !checkResiduals(*storage, d.cache.place, *d.residuals, d.residuals.place, diagnostics))
        return nullptr;
    if (!checkTileSize(d, *storage, diagnostics) || !formatIsRight) return nullptr;

    const std::string target = "renderbuffer-" + std::to_string(size) + "-RGBA32F";
    ElevationProducer::Parameters parameters{
        .name = context.name(),
        .cache = d.cache.shared(),
        .residuals = d.residuals.shared(),
        .upsample = d.upsampleProg.shared(),
        .gridSize = d.gridSize,
        .noise = d.noise,
        .flip = d.flip,
        .face = faceOf(d, context.name()),
        .target = context.load<Texture>(target, d.place).shared(),
    };
    if (parameters.residuals) {
        const std::string name = "renderbuffer-" + std::to_string(size) + "-R32F";
        parameters.residualTexture = context.load<Texture>(name, d.place).shared();
        if (!parameters.residualTexture) return nullptr;
    }
    if (!parameters.target || !adoptLayers(d, context, parameters, target)) return nullptr;

    auto producer =
        makeProducer<ElevationProducer>(context.service<GlContext>(), std::move(parameters));
    for (const Child& child : d.children)
        if (auto layer = child.built<TileLayer>()) producer->addLayer(std::move(layer));
    return producer;
}

} // namespace

void declareElevationProducer(Registry& registry) {
    using D = ElevationDescription;
    registry
        .resource<ElevationProducer, D, TileProducer>(
            "elevationProducer",
            "Elevations of a terrain: the parent's, upsampled, plus residuals, plus noise.")
        .example(
            R"(<elevationProducer name="elevations" cache="elevationCache" noise="0,150,88,50,27,14.5,7.6"/>)")
        .attribute("cache", &D::cache,
                   "where the tiles are; a gpuTileStorage of floats, whose tileSize is a multiple "
                   "of 'gridSize', plus 5")
        .required()
        .attribute("residuals", &D::residuals, "producer of what is added to upsampled elevations")
        .attribute("upsampleProg", &D::upsampleProg, "shader that upsamples and adds")
        .attribute("blendProg", &D::blendProg, "shader that applies what layers drew")
        .onDemand()
        .attribute("gridSize", &D::gridSize, "quads along an edge of the mesh of a terrain quad")
        .atLeast(1)
        .atMost(16384)
        .attribute("noise", &D::noise, "amplitude of the noise of each level; none beyond")
        .unit("m")
        .attribute("flip", &D::flip, "whether the diagonals of the mesh follow the ridges")
        .attribute("face", &D::face,
                   "face of a planet, 1 to 6, for noise without seams; by default the last "
                   "character of the producer's name, if it is one of these")
        .atLeast(0)
        .atMost(6)
        .children<TileLayer>("changes elevations, in their order")
        .build(buildElevations);
}

} // namespace terrane
