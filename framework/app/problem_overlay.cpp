// SPDX-License-Identifier: BSD-3-Clause
#include "app/problem_overlay.h"

#include "render/framebuffer.h"

#include <algorithm>

namespace terrane {

namespace {

constexpr int kMargin = 6;                            // pixels
constexpr float kSmallest = 12, kLinesOnPicture = 40; // pixels, lines
constexpr float kCovered = 0.6F;                      // of the picture, at most
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
    // Folders would leave no room for the message.
    std::string place = d.place ? d.place.toString() + ": " : std::string();
    place.erase(0, place.find_last_of('/') + 1);
    lines_.push_back({place + d.message, d.severity, false});
    if (!d.expected.empty()) lines_.push_back({"    expected: " + d.expected, d.severity, true});
    if (!d.suggestion.empty())
        lines_.push_back({"    did you mean '" + d.suggestion + "'?", d.severity, true});
}

std::vector<ProblemOverlay::Line> ProblemOverlay::wrapped(float width, float size,
                                                          std::size_t mostLines) const {
    std::vector<Line> result;
    for (const Line& line : lines_) {
        std::string_view rest = line.text;
        while (!rest.empty() && result.size() < mostLines) {
            std::size_t fitting = rest.size();
            while (fitting > 1 && size * font_->width(rest.substr(0, fitting)) > width)
                --fitting;
            // Between words if there are any.
            const std::size_t blank = rest.substr(0, fitting).rfind(' ');
            if (fitting < rest.size() && blank != std::string_view::npos && blank > fitting / 2)
                fitting = blank + 1;
            result.push_back({std::string(rest.substr(0, fitting)), line.severity, line.remark});
            rest.remove_prefix(fitting);
        }
    }
    return result;
}

void ProblemOverlay::draw(Framebuffer& framebuffer) {
    if (lines_.empty() || !font_ || !program_) return;
    const PipelineState before = framebuffer.state;
    const PipelineState::Rectangle area = before.viewport;
    framebuffer.state = {};
    framebuffer.state.viewport = area;

    const float size = std::clamp(float(area.height) / kLinesOnPicture, kSmallest,
                                  std::max(kSmallest, font_->tileHeight()));
    const auto fitting = std::size_t(std::max(1.0F, kCovered * float(area.height) / size));
    const std::vector<Line> lines = wrapped(float(area.width - 2 * kMargin), size, fitting);
    const int height = int(size * float(lines.size())) + 2 * kMargin;
    framebuffer.state.scissor = {
        .enabled = true, .rectangle = {area.x, area.y + area.height - height, area.width, height}};
    framebuffer.state.clear.colour = {0.08F, 0.08F, 0.1F, 1};
    framebuffer.clear(Planes::colour);
    framebuffer.state.scissor = {};

    text_.begin({area.width, area.height});
    float pen = float(area.height - kMargin);
    for (const Line& line : lines) {
        pen -= size;
        const glm::u8vec4 colour = line.remark                          ? kGrey
                                   : line.severity == Severity::warning ? kYellow
                                                                        : kRed;
        text_.add(*font_, line.text, {float(kMargin), pen}, size, colour);
    }
    text_.blend(framebuffer, *program_, program_->find("font"), *font_);
    framebuffer.state = before;
}

} // namespace terrane
