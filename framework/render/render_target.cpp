// SPDX-License-Identifier: BSD-3-Clause
#include "render/render_target.h"

#include <cstring>

namespace terrane {

namespace {

std::shared_ptr<Texture> makePlane(const GlContext& context, InternalFormat format, int width,
                                   int height) {
    return std::make_shared<Texture>(
        context, TextureDescription{.format = format, .width = width, .height = height});
}

Image capturePlane(const Texture& colour, int channels) {
    Image image = makeImage(colour.width(), colour.height(), channels);
    const auto format = channels == 4 ? TransferFormat::rgba : TransferFormat::rgb;
    const auto bytes = colour.download(colour.region(), {format, TransferType::u8});
    std::memcpy(image.bytes.data(), bytes.data(), bytes.size());
    return image;
}

} // namespace

RenderTarget::RenderTarget(const GlContext& context, int width, int height)
    : colour_(makePlane(context, InternalFormat::rgba8, width, height))
    // As precise as 32 bits of float where depths crowd, near 1, and archives count on a stencil.
    , depth_(makePlane(context, InternalFormat::depth24Stencil8, width, height))
    , framebuffer_(context) {
    framebuffer_.attach(AttachmentPoint::colour0, {colour_});
    framebuffer_.attach(AttachmentPoint::depth, {depth_});
    framebuffer_.attach(AttachmentPoint::stencil, {depth_});
    framebuffer_.setDrawBuffers({AttachmentPoint::colour0});
    framebuffer_.setReadBuffer(AttachmentPoint::colour0);
    framebuffer_.fixBuffers();
    framebuffer_.state.viewport = {0, 0, width, height};
}

void RenderTarget::resize(int width, int height) {
    auto& viewport = framebuffer_.state.viewport;
    const bool covered = viewport == PipelineState::Rectangle{0, 0, this->width(), this->height()};
    colour_->resize(width, height);
    depth_->resize(width, height);
    if (covered) viewport = {0, 0, width, height};
}

Image RenderTarget::capture() const {
    return capturePlane(*colour_, 4);
}

Image RenderTarget::captureOpaque() const {
    return capturePlane(*colour_, 3);
}

} // namespace terrane
