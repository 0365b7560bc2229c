// SPDX-License-Identifier: BSD-3-Clause
#include "producer/tile_pass.h"

namespace terrane {

TilePass::TilePass(const GlContext& context, std::shared_ptr<Texture> target)
    : target_(std::move(target))
    , framebuffer_(context)
    , quad_(context, makeQuadMesh()) {
    framebuffer_.attach(AttachmentPoint::colour0, {target_});
}

void TilePass::addTargets(std::shared_ptr<Texture> colour1, std::shared_ptr<Texture> depth) {
    framebuffer_.attach(AttachmentPoint::colour1, {std::move(colour1)});
    framebuffer_.attach(AttachmentPoint::depth, {std::move(depth)});
}

void TilePass::begin(AttachmentPoint target) {
    framebuffer_.state = {};
    framebuffer_.state.viewport = {0, 0, target_->width(), target_->height()};
    framebuffer_.setDrawBuffers({target});
    framebuffer_.setReadBuffer(target);
}

void TilePass::draw(Program& program) {
    framebuffer_.use();
    program.use();
    quad_.draw();
}

} // namespace terrane
