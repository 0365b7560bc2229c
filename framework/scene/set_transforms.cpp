// SPDX-License-Identifier: BSD-3-Clause
#include "scene/set_transforms.h"

#include "core/text.h"
#include "render/program.h"
#include "resource/registry.h"
#include "scene/bind_context.h"
#include "scene/scene_manager.h"
#include "scene/set_program.h"

namespace terrane {

namespace {

struct SetTransformsDescription : ElementDescription {
    Attr<std::string> time, localToWorld, localToScreen, cameraToWorld, cameraToScreen,
        screenToCamera, worldToScreen, worldPos, worldDir;
    Attr<std::string> screen;
    Attr<Target> module;
};

class SetTransformsTask : public FrameTask {
public:
    SetTransformsTask(const SetTransformsDescription& d, SceneNode& node, SceneNode* screen,
                      Ref<Module> module, SceneManager& scene)
        : FrameTask("SetTransforms")
        , description_(d)
        , node_(node)
        , screen_(screen)
        , module_(std::move(module))
        , scene_(scene) {}

    bool run() override {
        Program* const program = receiver();
        if (!program) return false;
        if (program != program_) resolve(*program);
        const glm::dmat4& local = node_.localToWorld;
        time_.set(glm::vec2(scene_.time(), scene_.elapsed()));
        localToWorld_.set(glm::mat4(local));
        cameraToWorld_.set(glm::mat4(scene_.cameraToWorld()));
        cameraToScreen_.set(glm::mat4(scene_.cameraToScreen));
        screenToCamera_.set(glm::mat4(scene_.screenToCamera()));
        setToScreen();
        worldPos_.set(glm::vec3(local[3]));
        worldDir_.set(glm::vec3(-local[2]));
        return true;
    }

private:
    void setToScreen() const {
        if (!screen_) {
            localToScreen_.set(glm::mat4(node_.localToScreen));
            worldToScreen_.set(glm::mat4(scene_.worldToScreen()));
            return;
        }
        const glm::dmat4 toScreen = glm::inverse(screen_->localToWorld);
        localToScreen_.set(glm::mat4(toScreen * node_.localToWorld));
        worldToScreen_.set(glm::mat4(toScreen));
    }

    // The first program that uses the module, or the current one while none does.
    Program* receiver() const {
        if (module_ && !module_->programs().empty()) return module_->programs().front();
        return scene_.drawState().program;
    }

    // A name that the program does not have is none of its business; one of another type is an
    // oversight.
    template <class T>
    void find(Uniform<T>& uniform, const Attr<std::string>& name, Program& program) const {
        uniform = name.given ? program.uniform<T>(*name) : Uniform<T>();
        if (!uniform.active()) return;
        using Traits = UniformTraits<T>;
        const UniformType& type = uniform.type();
        const bool real = type.kind == UniformKind::float32 || type.kind == UniformKind::float64;
        if (real && type.columns == Traits::columns && type.rows == Traits::rows) return;
        const UniformType* const wanted =
            findUniformType(UniformKind::float32, Traits::columns, Traits::rows);
        scene_.resources().diagnostics().warning("uniform-type", name.place,
                                                 "uniform '" + *name + "' of program '" +
                                                     program.name() + "' is " +
                                                     withArticle(type.name),
                                                 std::string(wanted->name));
        uniform = {};
    }

    void resolve(Program& program) {
        program_ = &program;
        const SetTransformsDescription& d = description_;
        find(time_, d.time, program);
        find(localToWorld_, d.localToWorld, program);
        find(localToScreen_, d.localToScreen, program);
        find(cameraToWorld_, d.cameraToWorld, program);
        find(cameraToScreen_, d.cameraToScreen, program);
        find(screenToCamera_, d.screenToCamera, program);
        find(worldToScreen_, d.worldToScreen, program);
        find(worldPos_, d.worldPos, program);
        find(worldDir_, d.worldDir, program);
    }

    SetTransformsDescription description_;
    SceneNode& node_;
    SceneNode* screen_; ///< used instead of the real screen, if any
    Ref<Module> module_;
    SceneManager& scene_;
    Program* program_ = nullptr; ///< whose uniforms the handles are
    Uniform<glm::vec2> time_;
    Uniform<glm::mat4> localToWorld_, localToScreen_, cameraToWorld_, cameraToScreen_,
        screenToCamera_, worldToScreen_;
    Uniform<glm::vec3> worldPos_, worldDir_;
};

class SetTransforms : public SceneTask {
public:
    explicit SetTransforms(const SetTransformsDescription& d)
        : description_(d) {}

    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        SceneNode* screen = nullptr;
        if (description_.screen.given) {
            const std::string& text = *description_.screen;
            screen = context.findNode(text.substr(0, text.find('.')));
            if (!screen) {
                context.diagnostics().error("unknown-target", description_.screen.place,
                                            "no node matches the target '" + text + "'",
                                            "'this', '$variable', or a flag of a node");
                return nullptr;
            }
        }
        Ref<Module> module;
        if (description_.module.given) {
            module = findModule(description_.module, context);
            if (!module) return nullptr;
        }
        return makeStep<SetTransformsTask>(description_, context.owner(), screen, std::move(module),
                                           context.scene());
    }

private:
    SetTransformsDescription description_;
};

} // namespace

void declareSetTransforms(Registry& registry) {
    using D = SetTransformsDescription;
    registry
        .resource<SetTransforms, D, SceneTask>(
            "setTransforms", "Sets uniforms to transformations between the frames of the scene. "
                             "Each attribute names the uniform that is set.")
        .example(
            R"(<setTransforms screenToCamera="screenToCamera" cameraToWorld="cameraToWorld"/>)")
        .attribute("time", &D::time,
                   "vec2: time of the frame, and since the last one, in microseconds")
        .attribute("localToWorld", &D::localToWorld, "mat4: from this node to the world")
        .attribute("localToScreen", &D::localToScreen, "mat4: from this node to clip space")
        .attribute("cameraToWorld", &D::cameraToWorld, "mat4: from the camera to the world")
        .attribute("cameraToScreen", &D::cameraToScreen,
                   "mat4: from the camera to clip space, the projection")
        .attribute("screenToCamera", &D::screenToCamera, "mat4: from clip space to the camera")
        .attribute("worldToScreen", &D::worldToScreen, "mat4: from the world to clip space")
        .attribute("worldPos", &D::worldPos, "vec3: position of this node in the world")
        .attribute("worldDir", &D::worldDir, "vec3: direction of this node's -z axis in the world")
        .attribute("screen", &D::screen,
                   "a node, 'this', '$o' or a flag: its frame is meant where the names say screen, "
                   "without projection")
        .attribute(
            "module", &D::module,
            "sets those of the first program with this module; else, those of the current program")
        .build([](const D& d, BuildContext&) { return std::make_shared<SetTransforms>(d); });
}

} // namespace terrane
