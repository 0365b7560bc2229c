// SPDX-License-Identifier: BSD-3-Clause
#include "scene/set_state.h"

#include "render/framebuffer.h"
#include "scene/attachment_words.h"
#include "scene/bind_context.h"
#include "scene/scene_manager.h"
#include "scene/state_elements.h"

namespace terrane {

namespace {

struct SetStateDescription : ElementDescription {
    Attr<AttachmentPoint> readBuffer = AttachmentPoint::none;
    Attr<std::vector<AttachmentPoint>> drawBuffer;
    Attr<bool> clearColor = false, clearStencil = false, clearDepth = false;
};

/// Buffers first, then the state in document order, then the clear, which sees all of it.
class SetStateTask : public FrameTask {
public:
    SetStateTask(const SetStateDescription& d, SceneManager& scene)
        : FrameTask("SetState")
        , description_(d)
        , scene_(scene) {
        for (const Child& child : description_.children) {
            if (auto* element = dynamic_cast<const StateElement*>(child.description.get()))
                elements_.push_back(element);
        }
        if (description_.clearColor) planes_ = planes_ | Planes::colour;
        if (description_.clearStencil) planes_ = planes_ | Planes::stencil;
        if (description_.clearDepth) planes_ = planes_ | Planes::depth;
    }

    bool run() override {
        Framebuffer& framebuffer = *scene_.drawState().framebuffer;
        if (description_.readBuffer.given) framebuffer.setReadBuffer(description_.readBuffer);
        if (description_.drawBuffer.given) framebuffer.setDrawBuffers(*description_.drawBuffer);
        for (const StateElement* element : elements_)
            element->apply(framebuffer.state);
        if (planes_ != Planes::none) framebuffer.clear(planes_);
        return true;
    }

private:
    SetStateDescription description_; // keeps the elements alive
    SceneManager& scene_;
    std::vector<const StateElement*> elements_;
    Planes planes_ = Planes::none;
};

class SetState : public SceneTask {
public:
    explicit SetState(const SetStateDescription& description)
        : description_(description) {}
    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        return makeStep<SetStateTask>(description_, context.scene());
    }

private:
    SetStateDescription description_;
};

} // namespace

void declareSetState(Registry& registry) {
    using D = SetStateDescription;
    auto builder = registry.resource<SetState, D, SceneTask>(
        "setState", "Changes the state of the current framebuffer; it stays changed.");
    builder
        .example(R"(<setState name="clearForGround" clearColor="true" clearDepth="true">
    <clear r="0.6" g="0.7" b="0.9" a="1"/>
    <depth enable="true" value="LESS"/>
    <polygon back="CULL"/>
</setState>)")
        .attribute("readBuffer", &D::readBuffer, "buffer that pixels are read from",
                   kAttachmentWords)
        .attribute("drawBuffer", &D::drawBuffer, "buffers that are drawn into", kAttachmentWords)
        .attribute("clearColor", &D::clearColor, "clears the colours when it runs")
        .attribute("clearStencil", &D::clearStencil, "clears the stencil when it runs")
        .attribute("clearDepth", &D::clearDepth, "clears the depth when it runs");
    for (const ElementDeclaration* element : declareRasterStateElements(registry))
        builder.child(*element);
    for (const ElementDeclaration* element : declareFragmentStateElements(registry))
        builder.child(*element);
    builder.build([](const D& d, BuildContext&) { return std::make_shared<SetState>(d); });
}

} // namespace terrane
