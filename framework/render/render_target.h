// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/image.h"
#include "render/framebuffer.h"

#include <memory>

namespace terrane {

/// What the player draws the picture into, and what archives mean by the default framebuffer: RGBA8
/// colour and 32-bit depth of one size, in textures. GL thread only, with its context current.
class RenderTarget {
public:
    /// At least 1 x 1; the viewport covers it.
    RenderTarget(const GlContext& context, int width, int height);

    int width() const { return colour_->width(); }
    int height() const { return colour_->height(); }
    /// Contents are lost if the size differs. The viewport follows if it covered the target.
    void resize(int width, int height);

    Framebuffer& framebuffer() { return framebuffer_; }
    const Framebuffer& framebuffer() const { return framebuffer_; }
    const std::shared_ptr<Texture>& colour() const { return colour_; }
    /// Depth and stencil in one texture.
    const std::shared_ptr<Texture>& depth() const { return depth_; }

    /// The picture as 4 channels of 8 bits, bottom row first. Waits for the GPU.
    Image capture() const;
    /// The same without alpha, as screenshots are.
    Image captureOpaque() const;

private:
    std::shared_ptr<Texture> colour_;
    std::shared_ptr<Texture> depth_;
    Framebuffer framebuffer_;
};

} // namespace terrane
