// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/declare.h"
#include "plugins/terrain/normal_producer.h"
#include "plugins/terrain/storage_checks.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"

namespace terrane {

namespace {

enum class Shape { none, sphere };

const Words<Shape> kShapeWords{{"none", Shape::none}, {"sphere", Shape::sphere}};

struct NormalDescription : ElementDescription {
    Ref<TileCache> cache;
    Ref<TileProducer> elevations;
    Ref<Program> normalProg{"normalShader;"};
    Attr<int> gridSize = 24;
    Attr<Shape> deform = Shape::none;
};

bool checkFormat(const GpuTileStorage& storage, const Place& reference, Diagnostics& diagnostics) {
    const InternalFormatInfo& format = storage.format();
    const bool kind = format.kind == ChannelKind::real || format.kind == ChannelKind::normalized;
    if (kind && !format.compressed && (format.channels == 2 || format.channels == 4)) return true;
    reportFormat(storage, reference, "normals can't be stored as " + std::string(format.name),
                 "two or four channels of bytes or floats, such as RG8 or RGBA16F", diagnostics);
    return false;
}

bool checkTileSize(const NormalDescription& d, const GpuTileStorage& storage,
                   Diagnostics& diagnostics) {
    const TileProducer& elevations = *d.elevations;
    const int right = elevations.cache().storage().tileSize() - 2 * elevations.border();
    if (storage.tileSize() != right) {
        reportTileSize(storage, d.cache.place,
                       "normals of the elevations '" + elevations.name() + "'",
                       std::to_string(right) + ", their tile size less their borders", diagnostics);
        return false;
    }
    if ((right - 1) % d.gridSize == 0) return true;
    diagnostics.error("wrong-grid-size", d.gridSize.place,
                      "gridSize " + std::to_string(*d.gridSize) + " does not divide the " +
                          std::to_string(right - 1) + " texels along the edge of a quad",
                      "the gridSize of the elevations");
    return false;
}

std::shared_ptr<NormalProducer> buildNormals(const NormalDescription& d, BuildContext& context) {
    Diagnostics& diagnostics = context.diagnostics();
    const GpuTileStorage* const storage = gpuStorage(d.cache, diagnostics);
    if (!storage) return nullptr;
    if (!d.elevations->isGpu()) {
        diagnostics.error("wrong-producer", d.elevations.place,
                          "the tiles of '" + d.elevations->name() + "' are not on the GPU",
                          "an elevationProducer");
        return nullptr;
    }
    const bool formatIsRight = checkFormat(*storage, d.cache.place, diagnostics);
    if (!checkTileSize(d, *storage, diagnostics) || !formatIsRight) return nullptr;

    // RG8 is drawn as RGBA8 (terrain reference 2.6).
    const bool bytes = storage->format().value == InternalFormat::rg8;
    const std::string format = bytes ? "RGBA8" : std::string(storage->format().name);
    const std::string target = "renderbuffer-" + std::to_string(storage->tileSize()) + "-" + format;
    NormalProducer::Parameters parameters{
        .name = context.name(),
        .cache = d.cache.shared(),
        .elevations = d.elevations.shared(),
        .program = d.normalProg.shared(),
        .gridSize = d.gridSize,
        .sphere = *d.deform == Shape::sphere,
        .target = context.load<Texture>(target, d.place).shared(),
    };
    if (!parameters.target) return nullptr;
    return makeProducer<NormalProducer>(context.service<GlContext>(), std::move(parameters));
}

} // namespace

void declareNormalProducer(Registry& registry) {
    using D = NormalDescription;
    registry
        .resource<NormalProducer, D, TileProducer>("normalProducer",
                                                   "Normals of a terrain, from its elevations.")
        .example(R"(<normalProducer name="normals" cache="normalCache" elevations="elevations"/>)")
        .attribute("cache", &D::cache,
                   "where the tiles are; a gpuTileStorage with two channels, or four to keep the "
                   "parent's normals too; tileSize that of the elevations - 4")
        .required()
        .attribute("elevations", &D::elevations, "producer of the elevations")
        .required()
        .attribute("normalProg", &D::normalProg, "shader that computes normals")
        .attribute("gridSize", &D::gridSize, "quads along an edge of the mesh of a terrain quad")
        .atLeast(1)
        .atMost(16384)
        .attribute("deform", &D::deform, "'sphere' for a face of a planet", kShapeWords)
        .otherWordsMeanDefault()
        .build(buildNormals);
}

} // namespace terrane
