// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/normal_producer.h"

#include <array>
#include <cassert>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace terrane {

namespace {

// Rows: east, north, up at the centre of a quad of a sphere's face (terrain reference 2.1).
glm::dmat3 tangentFrame(const TileCoordinates& quad, double radius) {
    const glm::dvec3 centre(quad.ox + quad.size / 2, quad.oy + quad.size / 2, radius);
    const glm::dvec3 up = glm::normalize(centre);
    const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), up));
    return glm::transpose(glm::dmat3(east, glm::cross(up, east), up));
}

} // namespace

NormalProducer::NormalProducer(const GlContext& context, Parameters parameters)
    : TileProducer(parameters.name, Task::Kind::gpu, "CreateNormalTile", parameters.cache)
    , parameters_(std::move(parameters))
    , width_(cache().storage().tileSize())
    , pass_(context, parameters_.target) {
    assert(isGpu() && parameters_.elevations->isGpu() && "NormalProducer: storages");
    const auto& storage = static_cast<const GpuTileStorage&>(cache().storage());
    fourChannels_ = storage.format().channels == 4;
    const bool isUnsigned = storage.format().kind == ChannelKind::normalized;
    format_ = static_cast<float>((fourChannels_ ? 0 : 2) + (isUnsigned ? 1 : 0));

    Program& program = *parameters_.program;
    tileSDF_ = program.uniform<glm::vec3>("tileSDF");
    elevationSampler_ = program.uniform<Texture>("elevationSampler");
    elevationOSL_ = program.uniform<glm::vec4>("elevationOSL");
    normalSampler_ = program.uniform<Texture>("normalSampler");
    normalOSL_ = program.uniform<glm::vec4>("normalOSL");
    patchCorners_ = program.uniform<glm::mat4>("patchCorners");
    patchVerticals_ = program.uniform<glm::mat4>("patchVerticals");
    patchCornerNorms_ = program.uniform<glm::vec4>("patchCornerNorms");
    worldToTangentFrame_ = program.uniform<glm::mat3>("worldToTangentFrame");
    parentToTangentFrame_ = program.uniform<glm::mat3>("parentToTangentFrame");
    deform_ = program.uniform<glm::vec4>("deform");
}

void NormalProducer::setRootQuadSize(float size) {
    TileProducer::setRootQuadSize(size);
    parameters_.elevations->setRootQuadSize(size);
}

bool NormalProducer::startCreateTile(const TileId& tile, TileInputs& inputs) {
    if (readsParent(tile) && !inputs.need(*this, tile.parent())) return false;
    return inputs.need(*parameters_.elevations, tile) &&
           TileProducer::startCreateTile(tile, inputs);
}

bool NormalProducer::doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs& inputs) {
    auto& gpuSlot = slot.as<GpuTileStorage::Slot>();
    tileSDF_.set({width_, (width_ - 1) / parameters_.gridSize, format_});
    setElevations(tile, inputs);
    setParent(tile, gpuSlot, inputs);
    setFrame(tile);
    pass_.begin();
    pass_.draw(*parameters_.program);
    TileProducer::doCreateTile(tile, slot, inputs);
    gpuSlot.copyFrom(pass_.framebuffer());
    return true;
}

void NormalProducer::setElevations(const TileId& tile, const TileInputs& inputs) {
    const auto& elevations =
        inputs.get(*parameters_.elevations, tile).slot().as<GpuTileStorage::Slot>();
    const auto size = static_cast<float>(elevations.texture()->width());
    // A quarter of a texel, as in the original, for shaders that sample nearest; ours round.
    const float offset = (static_cast<float>(parameters_.elevations->border()) + 0.25f) / size;
    elevationSampler_.set(elevations.texture());
    elevationOSL_.set({offset, offset, 1 / size, elevations.layer()});
}

void NormalProducer::setParent(const TileId& tile, const GpuTileStorage::Slot& slot,
                               const TileInputs& inputs) {
    if (!readsParent(tile)) {
        normalSampler_.set(slot.texture());
        normalOSL_.set(glm::vec4(-1));
        return;
    }
    const auto& parent = inputs.get(*this, tile.parent()).slot().as<GpuTileStorage::Slot>();
    const auto w = static_cast<float>(width_);
    const glm::vec2 d(static_cast<float>(tile.tx % 2) * w / 2,
                      static_cast<float>(tile.ty % 2) * w / 2);
    normalSampler_.set(parent.texture());
    normalOSL_.set({(d.x + 0.25f) / w, (d.y + 0.25f) / w, 1 / w, parent.layer()});
}

void NormalProducer::setFrame(const TileId& tile) {
    const TileCoordinates quad = tileCoordinates(tile, rootQuadSize());
    if (!parameters_.sphere) {
        worldToTangentFrame_.set(glm::mat3(1));
        parentToTangentFrame_.set(glm::mat3(1));
        deform_.set(glm::vec4(quad.ox, quad.oy, quad.size, 0));
        return;
    }
    const double radius = rootQuadSize() / 2;
    std::array<glm::dvec3, 4> up;
    glm::dvec4 norms;
    for (int i = 0; i < 4; ++i) {
        const glm::dvec3 corner(quad.ox + i % 2 * quad.size, quad.oy + i / 2 * quad.size, radius);
        norms[i] = glm::length(corner);
        up[static_cast<std::size_t>(i)] = corner / norms[i];
    }
    const glm::dvec3 centre = (up[0] + up[1] + up[2] + up[3]) / 4.0;
    glm::dmat4 corners, verticals;
    for (int i = 0; i < 4; ++i) {
        corners[i] = glm::dvec4((up[static_cast<std::size_t>(i)] - centre) * radius, 1);
        verticals[i] = glm::dvec4(up[static_cast<std::size_t>(i)], 0);
    }
    const glm::dmat3 frame = tangentFrame(quad, radius);
    patchCorners_.set(glm::mat4(corners));
    patchVerticals_.set(glm::mat4(verticals));
    patchCornerNorms_.set(glm::vec4(norms));
    worldToTangentFrame_.set(glm::mat3(frame));
    deform_.set(glm::vec4(quad.ox, quad.oy, quad.size, radius));
    if (tile.level == 0) return;
    const glm::dmat3 parent = tangentFrame(tileCoordinates(tile.parent(), rootQuadSize()), radius);
    parentToTangentFrame_.set(glm::mat3(frame * glm::transpose(parent)));
}

} // namespace terrane
