// SPDX-License-Identifier: BSD-3-Clause
#include "scene/set_target.h"

#include "render/framebuffer.h"
#include "render/module.h"
#include "render/texture.h"
#include "resource/registry.h"
#include "scene/attachment_words.h"
#include "scene/bind_context.h"
#include "scene/module_sampler.h"
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
    ModuleSampler sampler; ///< whose texture of the moment is meant, instead
    int level;
    int layer;
    Attr<Target> name;
    std::shared_ptr<Texture> current = {};
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
        const bool usable = findTextures() && attachAll(framebuffer) && isComplete(framebuffer);
        scene_.drawState().framebuffer = usable ? &framebuffer : &scene_.nowhere();
        if (!usable) return false;
        const Attachment& last = framebuffer.attachment(buffers_.back().point);
        framebuffer.state.viewport = {0, 0, last.width(), last.height()};
        return true;
    }

    /// What can be told once all programs are linked.
    void check() {
        for (BoundBuffer& buffer : buffers_) {
            const std::shared_ptr<Texture> texture = currentTexture(buffer);
            if (texture) canResize(buffer, *texture);
            // One without a texture may get it from what is drawn before.
            if (!texture && buffer.sampler && !buffer.sampler.exists()) reportMissing(buffer);
        }
    }

private:
    static std::shared_ptr<Texture> currentTexture(BoundBuffer& buffer) {
        return buffer.sampler ? buffer.sampler.texture() : buffer.texture.shared();
    }

    bool findTextures() {
        bool found = true;
        for (BoundBuffer& buffer : buffers_) {
            buffer.current = currentTexture(buffer);
            if (!buffer.current) reportMissing(buffer);
            found = found && buffer.current && canResize(buffer, *buffer.current);
        }
        return found;
    }

    void reportMissing(const BoundBuffer& buffer) const {
        scene_.resources().diagnostics().error("missing-texture", buffer.name.place,
                                               "'" + buffer.name->node + "." + buffer.name->name +
                                                   "' has no texture to draw into",
                                               "a sampler with a texture of an archive");
    }

    bool canResize(const BoundBuffer& buffer, const Texture& texture) const {
        const TextureTarget target = texture.description().target;
        if (!autoResize_ || target == TextureTarget::texture2D) return true;
        scene_.resources().diagnostics().error("wrong-kind", buffer.name.place,
                                               "only 2D textures can be resized with the screen",
                                               "a texture2D, or autoResize=\"false\"");
        return false;
    }

    bool attachAll(Framebuffer& framebuffer) const {
        detachOthers(framebuffer);
        for (const BoundBuffer& buffer : buffers_) {
            if (autoResize_) resize(*buffer.current);
            if (!attach(framebuffer, buffer)) return false;
        }
        return true;
    }

    // Asks OpenGL only when a texture is another one than the last time.
    bool isComplete(const Framebuffer& framebuffer) {
        std::array<std::uint64_t, kAttachmentPoints> serials{};
        for (const BoundBuffer& buffer : buffers_)
            serials[std::size_t(buffer.point)] = buffer.current->serial();
        if (checked_ == serials) return complete_;
        checked_ = serials;
        return complete_ = framebuffer.isComplete(scene_.resources().diagnostics(), place_);
    }

    bool attach(Framebuffer& framebuffer, const BoundBuffer& buffer) const {
        const Attachment attachment{buffer.current, buffer.level, buffer.layer};
        const std::string problem = Framebuffer::problem(buffer.point, attachment);
        if (problem.empty()) {
            framebuffer.attach(buffer.point, attachment);
            return true;
        }
        scene_.resources().diagnostics().error("bad-attachment", buffer.name.place, problem);
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

// `node.id` is a sampler value of the node; `node.module:sampler` what a module's sampler has.
// False, with a diagnostic, when there is no such thing.
bool findTexture(BoundBuffer& buffer, BindContext& context) {
    const Attr<Target>& name = buffer.name;
    SceneNode* const node = context.nodeOf(name);
    if (!node) {
        buffer.texture = context.resourceOf<Texture>(name);
        return static_cast<bool>(buffer.texture);
    }
    const std::size_t colon = name->name.find(':');
    if (colon == std::string::npos) {
        const auto value = node->values.find(name->name);
        const bool sampler =
            value != node->values.end() && value->second.type == NodeValue::Type::sampler;
        if (sampler) buffer.texture = value->second.texture; // if empty, told at the node
        if (!sampler) context.reportMissing(name, *node, "texture", node->values);
        return static_cast<bool>(buffer.texture);
    }
    const auto module = node->modules.find(name->name.substr(0, colon));
    if (module == node->modules.end()) {
        context.reportMissing(name, *node, "texture", node->modules);
        return false;
    }
    if (!module->second) return false; // told at the node
    buffer.sampler = ModuleSampler(module->second, name->name.substr(colon + 1));
    return true;
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
            BoundBuffer buffer{b.point, {}, {}, b.level, b.layer, b.texture};
            complete &= findTexture(buffer, context);
            bound.push_back(std::move(buffer));
        }
        if (!complete || bound.empty()) return makeStep<SetNowhereTask>(context.scene());
        auto task =
            std::make_shared<SetTargetTask>(std::move(bound), autoResize_, place_, context.scene());
        // A sampler may have its texture from a program that is linked later in this frame.
        context.whenBound([task] { task->check(); });
        return std::make_unique<BoundStep>(task);
    }

private:
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
            .attribute("name", &B::point, "the output of the shaders that it takes",
                       kAttachmentWords)
            .required()
            .attribute("texture", &B::texture,
                       "the texture: its name, its key at a node, such as 'this.map', or a sampler "
                       "of a module of a node, such as 'this.material:map'")
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
        .example(R"(<setTarget name="toMaps" autoResize="true">
    <buffer name="COLOR0" texture="colourMap"/>
    <buffer name="DEPTH" texture="depthMap"/>
</setTarget>)")
        .attribute("autoResize", &D::autoResize, "gives the textures the size of the screen")
        .child(buffer)
        .build([](const D& d, BuildContext&) { return std::make_shared<SetTarget>(d); });
}

} // namespace terrane
