// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/declare.h"
#include "plugins/terrain/residual_producer.h"
#include "plugins/terrain/storage_checks.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"

namespace terrane {

namespace {

struct ResidualDescription : ElementDescription {
    Ref<TileCache> cache;
    Attr<DataFile> file;
    Attr<int> delta = 0;
    Attr<float> scale = 1.0f;
};

// What can be told without reading tiles.
void reportFaults(const ResidualFile& file, const ResidualDescription& d,
                  Diagnostics& diagnostics) {
    const ResidualFile::Faults faults = file.faults();
    if (faults.count == 0) return;
    const TileId& first = faults.first;
    diagnostics.error("damaged-file", d.file.place,
                      "'" + d.file->name + "' is damaged: " + std::to_string(faults.count) +
                          " of its " + std::to_string(file.tiles()) + " tiles " +
                          (faults.count == 1 ? "lies" : "lie") +
                          " outside of the file, first tile " + std::to_string(first.level) + "/" +
                          std::to_string(first.tx) + "/" + std::to_string(first.ty),
                      "the whole file; without it, the ground has no residuals there");
}

// A file whose header makes no sense is none: the ground has no residuals, but there is ground.
void parse(const ResidualDescription& d, std::shared_ptr<const RandomAccessFile> file,
           ResidualPyramid::Parameters& parameters, Diagnostics& diagnostics) {
    std::string problem;
    parameters.file = ResidualFile::parse(std::move(file), problem);
    if (parameters.file) return reportFaults(*parameters.file, d, diagnostics);
    diagnostics.error("damaged-file", d.file.place,
                      "'" + d.file->name + "' is damaged or no residual file: " + problem,
                      "a DEM.dat; without it, the ground has no residuals");
}

bool open(const ResidualDescription& d, BuildContext& context,
          ResidualPyramid::Parameters& parameters) {
    auto file = context.openFile(d.file->name, d.file.place);
    if (!file) return false;
    parse(d, std::move(file), parameters, context.diagnostics());
    return true;
}

bool checkStorage(const ResidualDescription& d, const CpuFloatTileStorage& storage,
                  const ResidualFile* file, Diagnostics& diagnostics) {
    if (storage.channels() != 1) {
        reportFormat(storage, d.cache.place,
                     "residuals can't be stored in " + std::to_string(storage.channels()) +
                         " channels",
                     "1 channel", diagnostics);
        return false;
    }
    const int right = file ? file->header().tileSize + ResidualFile::kRest : storage.tileSize();
    if (storage.tileSize() == right) return true;
    reportTileSize(storage, d.cache.place, "the residuals of '" + d.file->name + "'",
                   std::to_string(right) + ", the file's " +
                       std::to_string(file->header().tileSize) + " + 5",
                   diagnostics);
    return false;
}

// Nothing when it is wrong.
std::optional<int> deltaOf(const ResidualDescription& d, const ResidualFile* file,
                           Diagnostics& diagnostics) {
    if (!file) return 0;
    const ResidualHeader& header = file->header();
    if (header.rootLevel > 0) { // terrain reference 1.7
        if (d.delta != 0)
            diagnostics.warning("unused-attribute", d.delta.place,
                                "'" + d.file->name + "' is a sub-pyramid: its delta is 0");
        return 0;
    }
    const int largest = file->largestDelta();
    if (d.delta <= largest) return d.delta;
    diagnostics.error("out-of-range", d.delta.place,
                      "delta is " + std::to_string(*d.delta) + ", but '" + d.file->name +
                          "' allows " + std::to_string(largest) + " at most",
                      largest > 0 ? "0 to " + std::to_string(largest) : "0");
    return std::nullopt;
}

std::unique_ptr<ResidualPyramid> makePyramid(const ResidualDescription& d, BuildContext& context);

// Nested files refine parts of the one around them (terrain reference 4.1): they are sub-pyramids
// with tiles as large.
bool checkPart(const ResidualDescription& d, const ResidualHeader& part,
               const ResidualDescription& whole, const ResidualHeader& header,
               Diagnostics& diagnostics) {
    const std::string right = std::to_string(header.tileSize);
    if (part.rootLevel == 0) {
        diagnostics.error("wrong-kind", d.file.place,
                          "'" + d.file->name + "' is a whole pyramid and can't refine '" +
                              whole.file->name + "': its root level is 0",
                          "a sub-pyramid with tiles of " + right +
                              ", whose root level is that of the tile that it refines");
        return false;
    }
    if (part.tileSize == header.tileSize) return true;
    diagnostics.error("wrong-tile-size", d.file.place,
                      "'" + d.file->name + "' has tiles of " + std::to_string(part.tileSize) +
                          " and can't refine '" + whole.file->name + "'",
                      "a file with tiles of " + right);
    return false;
}

void addParts(const ResidualDescription& d, BuildContext& context,
              ResidualPyramid::Parameters& parameters) {
    for (const Child& child : d.children) {
        const auto* const nested = child.as<ResidualDescription>();
        auto part = makePyramid(*nested, context);
        if (!part || !part->file() || !parameters.file) continue;
        if (checkPart(*nested, part->file()->header(), d, parameters.file->header(),
                      context.diagnostics()))
            parameters.parts.push_back(std::move(part));
    }
}

std::unique_ptr<ResidualPyramid> makePyramid(const ResidualDescription& d, BuildContext& context) {
    Diagnostics& diagnostics = context.diagnostics();
    ResidualPyramid::Parameters parameters;
    parameters.name = d.file->name;
    parameters.place = d.file.place;
    parameters.scale = d.scale;
    const bool found = d.file->name.empty() || open(d, context, parameters);
    const ResidualFile* const file = parameters.file ? &*parameters.file : nullptr;

    const auto* const storage =
        d.cache ? cpuFloatStorage(*d.cache, d.cache.place, diagnostics) : nullptr;
    const bool fits = storage && checkStorage(d, *storage, file, diagnostics);
    const auto delta = deltaOf(d, file, diagnostics);
    addParts(d, context, parameters);
    if (!found || !fits || !delta) return nullptr;
    parameters.delta = *delta;
    return std::make_unique<ResidualPyramid>(std::move(parameters),
                                             context.manager().diagnostics());
}

std::shared_ptr<ResidualProducer> buildResiduals(const ResidualDescription& d,
                                                 BuildContext& context) {
    auto pyramid = makePyramid(d, context);
    if (!pyramid) return nullptr;
    return makeProducer<ResidualProducer>(context.name(), d.cache.shared(), std::move(pyramid));
}

template <class Builder>
void declareAttributes(Builder& builder) {
    using D = ResidualDescription;
    builder
        .attribute("cache", &D::cache,
                   "where the tiles are; a cpuFloatTileStorage with one channel, tileSize that of "
                   "the file + 5")
        .required()
        .attribute("file", &D::file, "the pyramid, DEM.dat; without it, residuals are zero")
        .attribute("delta", &D::delta,
                   "level of the file that is the root tile; each doubles the tile size of the "
                   "elevations")
        .atLeast(0)
        .attribute("scale", &D::scale, "multiplies the scale of the file");
}

// The original's archives number them.
std::vector<std::string> nestedTags() {
    std::vector<std::string> tags{"residualProducer"};
    for (int i = 1; i <= 16; ++i)
        tags.push_back("residualProducer" + std::to_string(i));
    return tags;
}

} // namespace

void declareResidualProducer(Registry& registry) {
    // The original knew nested ones by the first sixteen characters of their tags.
    auto part = registry.element<ResidualDescription>(
        "residualProducer", "A file that refines a part of the one around it.");
    part.prefix(nestedTags()).ignored("name", "ignored");
    declareAttributes(part);
    part.child(part.declaration());

    auto residuals = registry.resource<ResidualProducer, ResidualDescription, TileProducer>(
        "residualProducer",
        "Elevations from a file: of the root tile, and for the others what is to be added to the "
        "level above.");
    declareAttributes(residuals);
    residuals
        .example(
            R"(<residualProducer name="residuals" cache="residualCache" file="DEM.dat" delta="2">
    <residualProducer cache="residualCache" file="valley.dat"/>
</residualProducer>)")
        .child(part.declaration())
        .build(buildResiduals);
}

} // namespace terrane
