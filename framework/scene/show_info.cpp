// SPDX-License-Identifier: BSD-3-Clause
#include "scene/show_info.h"

#include "resource/registry.h"
#include "scene/bind_context.h"
#include "scene/scene_manager.h"
#include "scene/text_overlay.h"

#include <array>
#include <cstdio>

namespace terrane {

namespace {

struct ShowInfoDescription : TextDescription {
    Attr<std::vector<int>> fontColor = std::vector<int>{255, 0, 0};
};

/// Frames per second of the scene's own clock, so that pictures of a fixed clock are all the same.
class FrameRate {
public:
    /// @param elapsed microseconds since the last frame
    void count(double elapsed) {
        if (elapsed <= 0) return;
        ++frames_;
        time_ += elapsed;
        const bool enough = time_ > 1e6;
        if (enough || !measured_) rate_ = frames_ / time_ * 1e6;
        if (!enough) return;
        measured_ = true;
        frames_ = 0;
        time_ = 0;
    }
    /// 0 until there is one.
    double rate() const { return rate_; }

private:
    int frames_ = 0;
    double time_ = 0;
    double rate_ = 0;
    bool measured_ = false; ///< over a whole second
};

class ShowInfoTask : public TextTask {
public:
    ShowInfoTask(const ShowInfoDescription& d, SceneManager& scene)
        : TextTask("ShowInfo", d, scene)
        , colour_((*d.fontColor)[0], (*d.fontColor)[1], (*d.fontColor)[2], 255) {}

private:
    void write() override {
        rate_.count(scene_.elapsed());
        const auto& texts = scene_.infoTexts().all();
        const auto own = texts.find("FPS");
        if (own != texts.end() && !own->second.empty())
            line(own->second, colour_);
        else
            writeRate();
        for (const auto& [topic, text] : texts) {
            if (topic != "FPS" && !text.empty()) line(text, colour_);
        }
    }

    void writeRate() {
        std::array<char, 32> text{};
        if (rate_.rate() > 0)
            std::snprintf(text.data(), text.size(), "%.1f FPS", rate_.rate());
        else
            std::snprintf(text.data(), text.size(), "-- FPS");
        line(text.data(), colour_);
    }

    glm::u8vec4 colour_;
    FrameRate rate_;
};

class ShowInfo : public SceneTask {
public:
    explicit ShowInfo(const ShowInfoDescription& d)
        : description_(d) {}
    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        return makeStep<ShowInfoTask>(description_, context.scene());
    }

private:
    ShowInfoDescription description_;
};

void check(const ShowInfoDescription& d, Diagnostics& diagnostics) {
    if (d.fontColor->size() == 3) return;
    diagnostics.error("wrong-kind", d.fontColor.place,
                      "a colour of " + std::to_string(d.fontColor->size()) + " numbers",
                      "red, green and blue, such as '255,0,0'");
}

} // namespace

void declareShowInfo(Registry& registry) {
    using D = ShowInfoDescription;
    auto info = registry.resource<ShowInfo, D, SceneTask>(
        "showInfo", "Writes the frame rate and other facts on the picture.");
    declareText<D>(info);
    info.example(R"(<showInfo fontSize="16" fontColor="255,255,255"/>)")
        .attribute("maxLines", static_cast<Attr<int> D::*>(&D::maxLines),
                   "lines to leave room for above the bottom")
        .atLeast(0)
        .clamped()
        .attribute("fontColor", &D::fontColor, "red, green and blue, 0 to 255")
        .atLeast(0)
        .atMost(255)
        .clamped()
        .check(check)
        .build([](const D& d, BuildContext&) { return std::make_shared<ShowInfo>(d); });
}

} // namespace terrane
