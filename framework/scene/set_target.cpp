// SPDX-License-Identifier: BSD-3-Clause
#include "scene/set_target.h"

#include "render/framebuffer.h"
#include "render/module.h"
#include "render/texture.h"
#include "resource/registry.h"
#include "scene/attachment_words.h"
#include "scene/bind_context.h"
#include "scene/scene_manager.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace terrane {

namespace {

struct BufferDescription : ElementDescription {
    Attr<AttachmentPoint> point = AttachmentPoint::none;
    Attr<Target> texture;
    Attr<int> level = 0;
    Attr<int> layer = 0;
};

struct SetTargetDescription : ElementDescription {
    Attr<bool> autoResize = false;
};

struct BoundBuffer {
    AttachmentPoint point;
    Ref<Texture> texture;
    int level;
    int layer;
    Place place;
};

/// Nothing that follows is seen: it would be drawn where it does not belong.
class SetNowhereTask : public FrameTask {
public:
    explicit SetNowhereTask(SceneManager& scene)
        : FrameTask("SetTarget")
        , scene_(scene) {}
    bool run() override {
        scene_.drawState().framebuffer = &scene_.nowhere();
        return true;
    }

private:
    SceneManager& scene_;
};

/// Back to the screen; the textures drawn into get their mipmaps.
class SetScreenTask : public FrameTask {
public:
    explicit SetScreenTask(SceneManager& scene)
        : FrameTask("SetTarget")
        , scene_(scene) {}
    bool run() override {
        scene_.offscreen().generateMipmaps();
        scene_.drawState().framebuffer = scene_.drawState().screen;
        return true;
    }

private:
    SceneManager& scene_;
};

class SetTargetTask : public FrameTask {
public:
    SetTargetTask(std::vector<BoundBuffer> buffers, bool autoResize, const Place& place,
                  SceneManager& scene)
        : FrameTask("SetTarget")
        , buffers_(std::move(buffers))
        , autoResize_(autoResize)
        , place_(place)
        , scene_(scene) {}

    bool run() override {
        Framebuffer& framebuffer = scene_.offscreen();
        const bool usable = attachAll(framebuffer) && isComplete(framebuffer);
        scene_.drawState().framebuffer = usable ? &framebuffer : &scene_.nowhere();
        if (!usable) return false;
        const Attachment& last = framebuffer.attachment(buffers_.back().point);
        framebuffer.state.viewport = {0, 0, last.width(), last.height()};
        return true;
    }

private:
    bool attachAll(Framebuffer& framebuffer) const {
        detachOthers(framebuffer);
        for (const BoundBuffer& buffer : buffers_) {
            if (autoResize_) resize(*buffer.texture);
            if (!attach(framebuffer, buffer)) return false;
        }
        return true;
    }

    // Asks OpenGL only when a texture is another one than the last time.
    bool isComplete(const Framebuffer& framebuffer) {
        std::array<std::uint64_t, kAttachmentPoints> serials{};
        for (const BoundBuffer& buffer : buffers_)
            serials[std::size_t(buffer.point)] = buffer.texture->serial();
        if (checked_ == serials) return complete_;
        checked_ = serials;
        return complete_ = framebuffer.isComplete(scene_.resources().diagnostics(), place_);
    }

    bool attach(Framebuffer& framebuffer, const BoundBuffer& buffer) const {
        const Attachment attachment{buffer.texture.shared(), buffer.level, buffer.layer};
        const std::string problem = Framebuffer::problem(buffer.point, attachment);
        if (problem.empty()) {
            framebuffer.attach(buffer.point, attachment);
            return true;
        }
        scene_.resources().diagnostics().error("bad-attachment", buffer.place, problem);
        return false;
    }

    void detachOthers(Framebuffer& framebuffer) const {
        for (int i = 0; i < kAttachmentPoints; ++i) {
            const auto point = static_cast<AttachmentPoint>(i);
            const auto listed = [&](const BoundBuffer& b) { return b.point == point; };
            if (std::none_of(buffers_.begin(), buffers_.end(), listed)) framebuffer.detach(point);
        }
    }

    void resize(Texture& texture) const {
        const PipelineState::Rectangle& screen = scene_.drawState().screen->state.viewport;
        if (texture.width() != screen.width || texture.height() != screen.height)
            texture.resize(screen.width, screen.height);
    }

    std::vector<BoundBuffer> buffers_;
    bool autoResize_;
    Place place_;
    SceneManager& scene_;
    std::array<std::uint64_t, kAttachmentPoints> checked_{}; ///< serials of the textures
    bool complete_ = false;
};

// `node.id` is a sampler value of the node; `node.module:sampler` what a module gives a sampler.
Ref<Texture> findTexture(const Attr<Target>& name, BindContext& context) {
    SceneNode* const node = context.nodeOf(name);
    if (!node) return context.resources().get<Texture>(name->name, name.place);
    const std::size_t colon = name->name.find(':');
    if (colon == std::string::npos) {
        const auto value = node->values.find(name->name);
        const bool sampler =
            value != node->values.end() && value->second.type == NodeValue::Type::sampler;
        if (sampler) return value->second.texture; // if empty, told at the node
        context.reportMissing(name, *node, "texture");
        return {};
    }
    const auto module = node->modules.find(name->name.substr(0, colon));
    const std::string sampler = name->name.substr(colon + 1);
    if (module != node->modules.end() && !module->second) return {}; // told at the node
    if (module != node->modules.end()) {
        for (const InitialUniform& uniform : module->second->uniforms()) {
            if (uniform.name == sampler && uniform.texture) return uniform.texture;
        }
    }
    context.reportMissing(name, *node, "texture");
    return {};
}

class SetTarget : public SceneTask {
public:
    explicit SetTarget(const SetTargetDescription& d)
        : autoResize_(d.autoResize)
        , place_(d.place) {
        for (const Child& child : d.children) {
            const auto* buffer = child.as<BufferDescription>();
            if (!buffer) continue;
            toScreen_ = false;
            if (*buffer->point != AttachmentPoint::none) buffers_.push_back(*buffer);
        }
    }

    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        if (toScreen_) return makeStep<SetScreenTask>(context.scene());
        std::vector<BoundBuffer> bound;
        bool complete = true;
        for (const BufferDescription& b : buffers_) {
            const Ref<Texture> texture = findTexture(b.texture, context);
            complete &= texture && canResize(*texture, b, context);
            bound.push_back({b.point, texture, b.level, b.layer, b.texture.place});
        }
        if (!complete || bound.empty()) return makeStep<SetNowhereTask>(context.scene());
        return makeStep<SetTargetTask>(std::move(bound), autoResize_, place_, context.scene());
    }

private:
    bool canResize(const Texture& texture, const BufferDescription& b, BindContext& context) const {
        const TextureTarget target = texture.description().target;
        if (!autoResize_ || target == TextureTarget::texture2D) return true;
        context.diagnostics().error("wrong-kind", b.texture.place,
                                    "only 2D textures can be resized with the screen",
                                    "a texture2D, or autoResize=\"false\"");
        return false;
    }

    bool autoResize_;
    Place place_;
    bool toScreen_ = true; ///< no buffer is listed
    std::vector<BufferDescription> buffers_;
};

void checkBuffer(const BufferDescription& d, Diagnostics& diagnostics) {
    if (*d.point != AttachmentPoint::none) return;
    diagnostics.warning("unused-element", d.point.place, "a buffer NONE has no effect",
                        "COLOR0 to COLOR7, DEPTH or STENCIL");
}

} // namespace

void declareSetTarget(Registry& registry) {
    using B = BufferDescription;
    const ElementDeclaration& buffer =
        registry.element<B>("buffer", "A texture that is drawn into.")
            .attribute("name", &B::point, "which output", kAttachmentWords)
            .required()
            .attribute("texture", &B::texture,
                       "a texture, 'target.value id' or 'target.module id:sampler'")
            .required()
            .attribute("level", &B::level, "mipmap level")
            .atLeast(0)
            .attribute("layer", &B::layer, "layer, slice or cube face; -1: all")
            .atLeast(-1)
            .check(checkBuffer)
            .declaration();
    using D = SetTargetDescription;
    registry
        .resource<SetTarget, D, SceneTask>(
            "setTarget", "Draws into textures from now on; without buffers, into the screen again.")
        .attribute("autoResize", &D::autoResize, "gives the textures the size of the screen")
        .child(buffer)
        .build([](const D& d, BuildContext&) { return std::make_shared<SetTarget>(d); });
}

} // namespace terrane
