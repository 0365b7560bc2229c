// SPDX-License-Identifier: BSD-3-Clause
#include "scene/show_log.h"

#include "resource/registry.h"
#include "scene/bind_context.h"
#include "scene/scene_manager.h"
#include "scene/text_overlay.h"

#include <algorithm>

namespace terrane {

namespace {

struct ShowLogDescription : TextDescription {};

glm::u8vec4 colourOf(Severity severity) {
    switch (severity) {
    case Severity::note:
        return {0, 255, 0, 255};
    case Severity::warning:
        return {255, 192, 0, 255};
    case Severity::error:
        break;
    }
    return {255, 0, 0, 255};
}

class ShowLogTask : public TextTask {
public:
    ShowLogTask(const ShowLogDescription& d, SceneManager& scene)
        : TextTask("ShowLog", d, scene)
        , maxLines_(std::size_t(*d.maxLines)) {}

private:
    void write() override {
        MessageLog& log = scene_.messageLog();
        log.update(scene_.resources().diagnostics());
        if (!log.visible) return;
        const auto& lines = log.lines();
        const std::size_t count = std::min(maxLines_, lines.size());
        for (std::size_t i = lines.size() - count; i < lines.size(); ++i)
            line(lines[i].text, colourOf(lines[i].severity));
    }

    std::size_t maxLines_;
};

class ShowLog : public SceneTask {
public:
    explicit ShowLog(const ShowLogDescription& d)
        : description_(d) {}
    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        return makeStep<ShowLogTask>(description_, context.scene());
    }

private:
    ShowLogDescription description_;
};

} // namespace

void declareShowLog(Registry& registry) {
    using D = ShowLogDescription;
    auto log = registry.resource<ShowLog, D, SceneTask>(
        "showLog", "Writes the newest messages on the picture, once there is a warning or error.");
    declareText<D>(log);
    log.attribute("maxLines", static_cast<Attr<int> D::*>(&D::maxLines),
                  "lines to show, the newest ones")
        .atLeast(0)
        .clamped()
        .build([](const D& d, BuildContext&) { return std::make_shared<ShowLog>(d); });
}

} // namespace terrane
