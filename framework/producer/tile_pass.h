// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/framebuffer.h"
#include "render/mesh.h"
#include "render/program.h"

#include <memory>

namespace terrane {

/// Draws programs over a square texture, pixel by pixel: how tiles are computed on the GPU. The
/// target is a scratch texture, as a rule one that is shared by name (`renderbuffer-101-RGBA32F`):
/// a tile is copied from there to its slot at once (terrain reference 2, 2.4). The vertices are
/// (-1,-1), (1,-1), (-1,1), (1,1), with z = 0 and w = 1, at location 0.
class TilePass {
public:
    TilePass(const GlContext& context, std::shared_ptr<Texture> target);
    /// Adds COLOR1, of the same size, and depth.
    void addTargets(std::shared_ptr<Texture> colour1, std::shared_ptr<Texture> depth);

    Framebuffer& framebuffer() { return framebuffer_; }
    const std::shared_ptr<Texture>& target() const { return target_; }

    /// Plain state (no tests, no blending, everything is written), into and from one target.
    void begin(AttachmentPoint target = AttachmentPoint::colour0);
    /// Draws with the uniforms that the program has.
    void draw(Program& program);

private:
    std::shared_ptr<Texture> target_;
    Framebuffer framebuffer_;
    Mesh quad_;
};

} // namespace terrane
