// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/elevation_producer.h"

#include "plugins/terrain/noise_image.h"

#include <cassert>
#include <cmath>

namespace terrane {

namespace {

std::shared_ptr<Texture> makeNoiseTexture(const GlContext& context, int width) {
    const NoiseImage<float> image = makeElevationNoise(width);
    auto texture = std::make_shared<Texture>(
        context,
        TextureDescription{.target = TextureTarget::texture2DArray,
                           .format = InternalFormat::r16f,
                           .width = width,
                           .height = width,
                           .layers = kNoiseLayers},
        SamplingParameters{
            .mag = MagFilter::nearest, .wrapS = Wrap::repeat, .wrapT = Wrap::repeat});
    texture->upload({TransferFormat::red, TransferType::f32},
                    std::as_bytes(std::span(image.values)));
    return texture;
}

// Samplers must have a texture even when the program is told not to read it.
std::shared_ptr<Texture> makeZeroTexture(const GlContext& context) {
    auto texture =
        std::make_shared<Texture>(context, TextureDescription{.format = InternalFormat::r32f});
    texture->clear();
    return texture;
}

} // namespace

ElevationProducer::ElevationProducer(const GlContext& context, Parameters parameters)
    : TileProducer(parameters.name, Task::Kind::gpu, "CreateElevationTile", parameters.cache)
    , parameters_(std::move(parameters))
    , width_(cache().storage().tileSize())
    , n_(width_ - 1 - 2 * kBorder)
    , residuals_(parameters_.residuals, width_)
    , pass_(context, parameters_.target)
    , noiseTexture_(makeNoiseTexture(context, width_)) {
    assert(isGpu() && n_ > 0 && n_ % parameters_.gridSize == 0 && "ElevationProducer: tile size");
    if (parameters_.residuals) {
        residualTexels_.resize(static_cast<std::size_t>(width_) * width_);
    } else {
        parameters_.residualTexture = makeZeroTexture(context);
    }
    Program& upsample = *parameters_.upsample;
    tileWSDF_ = upsample.uniform<glm::vec4>("tileWSDF");
    coarseLevelSampler_ = upsample.uniform<Texture>("coarseLevelSampler");
    coarseLevelOSL_ = upsample.uniform<glm::vec4>("coarseLevelOSL");
    residualSampler_ = upsample.uniform<Texture>("residualSampler");
    residualOSH_ = upsample.uniform<glm::vec4>("residualOSH");
    noiseSampler_ = upsample.uniform<Texture>("noiseSampler");
    noiseUVLH_ = upsample.uniform<glm::vec4>("noiseUVLH");
    if (!parameters_.blend) return;
    blendSampler_ = parameters_.blend->uniform<Texture>("coarseLevelSampler");
    blendScale_ = parameters_.blend->uniform<float>("scale");
    const TextureDescription depth{
        .format = InternalFormat::depth32f, .width = width_, .height = width_};
    pass_.addTargets(parameters_.blendTarget, std::make_shared<Texture>(context, depth));
}

void ElevationProducer::setRootQuadSize(float size) {
    TileProducer::setRootQuadSize(size);
    residuals_.setRootQuadSize(size);
}

bool ElevationProducer::prefetchTile(const TileId& tile) {
    if (TileProducer::prefetchTile(tile)) return true;
    // At least the file is read ahead.
    residuals_.prefetch(tile);
    return false;
}

bool ElevationProducer::startCreateTile(const TileId& tile, TileInputs& inputs) {
    if (tile.level > 0 && !inputs.need(*this, tile.parent())) return false;
    return residuals_.need(tile, inputs) && TileProducer::startCreateTile(tile, inputs);
}

bool ElevationProducer::doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs& inputs) {
    auto& gpuSlot = slot.as<GpuTileStorage::Slot>();
    const float texel =
        static_cast<float>(tileCoordinates(tile, rootQuadSize()).size / n_); // metres
    tileWSDF_.set({width_, texel, n_ / parameters_.gridSize, parameters_.flip ? 1 : 0});
    setParent(tile, gpuSlot, inputs);
    setResidual(tile, inputs);
    setNoise(tile);

    pass_.begin();
    pass_.framebuffer().state.clear.colour = {0, 0, 0, 255};
    pass_.framebuffer().clear(Planes::all);
    pass_.draw(*parameters_.upsample);
    if (parameters_.blend) blendLayers(tile, slot, inputs);
    gpuSlot.copyFrom(pass_.framebuffer());
    return true;
}

void ElevationProducer::setParent(const TileId& tile, const GpuTileStorage::Slot& slot,
                                  const TileInputs& inputs) {
    if (tile.level == 0) {
        coarseLevelSampler_.set(slot.texture());
        coarseLevelOSL_.set(glm::vec4(-1));
        return;
    }
    const auto& parent = inputs.get(*this, tile.parent()).slot().as<GpuTileStorage::Slot>();
    const glm::vec2 d(tile.tx % 2 * (n_ / 2), tile.ty % 2 * (n_ / 2));
    const auto w = static_cast<float>(width_);
    coarseLevelSampler_.set(parent.texture());
    coarseLevelOSL_.set({d.x / w, d.y / w, 1 / w, parent.layer()});
}

void ElevationProducer::setResidual(const TileId& tile, const TileInputs& inputs) {
    residualSampler_.set(parameters_.residualTexture);
    if (!residuals_.has(tile)) {
        residualOSH_.set({0, 0, 1, 0});
        return;
    }
    residuals_.copy(tile, inputs, {residualTexels_.data(), static_cast<std::size_t>(width_)});
    parameters_.residualTexture->upload({TransferFormat::red, TransferType::f32},
                                        std::as_bytes(std::span(residualTexels_)));
    const auto w = static_cast<float>(width_);
    residualOSH_.set({0.25f / w, 0.25f / w, 2 / w, 1});
}

void ElevationProducer::setNoise(const TileId& tile) {
    const NoiseTile noise =
        noiseTile(noiseEdgeCode(gradients_, parameters_.face, tile.level, tile.tx, tile.ty));
    const auto level = static_cast<std::size_t>(tile.level);
    const float amplitude = level < parameters_.noise.size() ? parameters_.noise[level] : 0;
    noiseSampler_.set(noiseTexture_);
    noiseUVLH_.set({noise.rotation, (noise.rotation + 1) % 4, noise.layer, amplitude});
}

// Layers change z and w of the upsampled elevations; the blend pass turns w into a weight between z
// and x (terrain reference 2.5).
void ElevationProducer::blendLayers(const TileId& tile, TileSlot& slot, const TileInputs& inputs) {
    pass_.begin();
    pass_.framebuffer().state.depth = {.enabled = true, .function = CompareFunction::less};
    pass_.framebuffer().use();
    TileProducer::doCreateTile(tile, slot, inputs);
    pass_.begin(AttachmentPoint::colour1);
    blendSampler_.set(pass_.target());
    blendScale_.set(1 / static_cast<float>(width_));
    pass_.draw(*parameters_.blend);
}

} // namespace terrane
