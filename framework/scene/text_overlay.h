// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/font.h"
#include "render/program.h"
#include "render/text_batch.h"
#include "resource/declaration.h"
#include "scene/scene_task.h"

#include <string_view>

namespace terrane {

class BindContext;
class SceneManager;

/// Attributes that showInfo and showLog share (ork reference 2.17).
struct TextDescription : ElementDescription {
    Attr<int> x = 4;
    Attr<int> y = -4;
    Attr<int> maxLines = 8;
    Ref<Font> font{"defaultFont"};
    Attr<float> fontSize = 0; ///< not given: that of the font
    Ref<Program> fontProgram{"text;"};
};

template <class D, class Builder>
void declareText(Builder& builder) {
    using T = TextDescription;
    const auto of = []<class V>(V T::*member) -> V D::* { return member; };
    builder.attribute("x", of(&T::x), "where lines start, from the left")
        .unit("pixels")
        .attribute("y", of(&T::y),
                   "above 0: distance of the first line from the top; else distance of the last "
                   "of 'maxLines' lines from the bottom, negated")
        .unit("pixels")
        .attribute("font", of(&T::font), "the letters")
        .attribute("fontSize", of(&T::fontSize), "height of a line; by default that of the font")
        .atLeast(1)
        .atMost(4096)
        .clamped()
        .unit("pixels")
        .attribute("fontProgram", of(&T::fontProgram),
                   "program that draws them, with a sampler 'font'");
}

/// Lines of text over the picture. For derived tasks, which say what the lines are.
class TextTask : public FrameTask {
public:
    bool run() override;

protected:
    TextTask(const char* name, const TextDescription& description, SceneManager& scene);

    /// Calls line() for each line, the first on top.
    virtual void write() = 0;
    void line(std::string_view text, const glm::u8vec4& colour);

    SceneManager& scene_;

private:
    float firstLine(int height) const;

    Ref<Font> font_;
    Ref<Program> program_;
    UniformHandle sampler_;
    glm::ivec2 origin_; ///< x and y as written
    int maxLines_;
    float fontSize_; ///< 0: that of the font
    TextBatch batch_;
    float pen_ = 0; ///< bottom of the next line
};

} // namespace terrane
