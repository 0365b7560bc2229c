// SPDX-License-Identifier: BSD-3-Clause
#include "scene/text_overlay.h"

#include "render/framebuffer.h"
#include "scene/scene_manager.h"

namespace terrane {

TextTask::TextTask(const char* name, const TextDescription& description, SceneManager& scene)
    : FrameTask(name)
    , scene_(scene)
    , font_(description.font)
    , program_(description.fontProgram)
    , sampler_(program_->find("font"))
    , origin_(*description.x, *description.y)
    , maxLines_(*description.maxLines)
    , fontSize_(*description.fontSize)
    , batch_(scene.context()) {
    if (!sampler_.active()) {
        scene.resources().diagnostics().warning("missing-sampler", description.fontProgram.place,
                                                "program '" + program_->name() +
                                                    "' has no sampler 'font' for the letters");
    }
}

bool TextTask::run() {
    Framebuffer& framebuffer = *scene_.drawState().framebuffer;
    const PipelineState::Rectangle& area = framebuffer.state.viewport;
    if (fontSize_ <= 0) fontSize_ = font_->tileHeight();
    batch_.begin({area.width, area.height});
    pen_ = firstLine(area.height);
    write();
    batch_.blend(framebuffer, *program_, sampler_, *font_);
    return true;
}

float TextTask::firstLine(int height) const {
    const auto y = float(origin_.y);
    if (y > 0) return float(height) - y - fontSize_;
    return float(maxLines_ - 1) * fontSize_ - y;
}

void TextTask::line(std::string_view text, const glm::u8vec4& colour) {
    batch_.add(*font_, text, {float(origin_.x), pen_}, fontSize_, colour);
    pen_ -= fontSize_;
}

} // namespace terrane
