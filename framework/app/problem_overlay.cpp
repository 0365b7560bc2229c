// SPDX-License-Identifier: BSD-3-Clause
#include "app/problem_overlay.h"

#include "render/framebuffer.h"

#include <algorithm>

namespace terrane {

namespace {

constexpr int kMargin = 6; // pixels
constexpr glm::u8vec4 kRed{255, 110, 90, 255}, kYellow{255, 210, 80, 255},
    kGrey{205, 205, 205, 255};

} // namespace

ProblemOverlay::ProblemOverlay(const Registry& registry, GlContext& context,
                               ProgramBindings& bindings)
    : library_(builtInSearchPath(), diagnostics_)
    , resources_(registry, library_, diagnostics_)
    , text_(context) {
    resources_.services().provide(context);
    resources_.services().provide(bindings);
    font_ = resources_.get<Font>("defaultFont");
    program_ = resources_.get<Program>("text;");
}

void ProblemOverlay::show(const std::vector<Diagnostic>& problems) {
    lines_.clear();
    for (const Diagnostic& problem : problems)
        add(problem);
}

void ProblemOverlay::add(const Diagnostic& d) {
    const std::string place = d.place ? d.place.toString() + ": " : std::string();
    lines_.push_back({place + d.message, d.severity, false});
    if (!d.expected.empty()) lines_.push_back({"    expected: " + d.expected, d.severity, true});
    if (!d.suggestion.empty())
        lines_.push_back({"    did you mean '" + d.suggestion + "'?", d.severity, true});
}

void ProblemOverlay::draw(Framebuffer& framebuffer) {
    if (lines_.empty() || !font_ || !program_) return;
    const PipelineState before = framebuffer.state;
    const PipelineState::Rectangle area = before.viewport;
    framebuffer.state = {};
    framebuffer.state.viewport = area;

    const auto fitting = std::size_t(std::max(1.0F, float(area.height) / lineHeight() - 1));
    const std::size_t count = std::min(lines_.size(), fitting);
    const int height = int(lineHeight() * float(count)) + 2 * kMargin;
    framebuffer.state.scissor = {
        .enabled = true, .rectangle = {area.x, area.y + area.height - height, area.width, height}};
    framebuffer.state.clear.colour = {0.08F, 0.08F, 0.1F, 1};
    framebuffer.clear(Planes::colour);
    framebuffer.state.scissor = {};

    text_.begin({area.width, area.height});
    float pen = float(area.height - kMargin);
    for (std::size_t i = 0; i < count; ++i) {
        const Line& line = lines_[i];
        pen -= lineHeight();
        const glm::u8vec4 colour = line.remark                          ? kGrey
                                   : line.severity == Severity::warning ? kYellow
                                                                        : kRed;
        text_.add(*font_, line.text, {float(kMargin), pen}, lineHeight(), colour);
    }
    text_.blend(framebuffer, *program_, program_->find("font"), *font_);
    framebuffer.state = before;
}

} // namespace terrane
