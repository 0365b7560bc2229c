// SPDX-License-Identifier: BSD-3-Clause
#include "scene/set_program.h"

#include "render/program.h"
#include "resource/registry.h"
#include "scene/bind_context.h"
#include "scene/scene_manager.h"

namespace terrane {

namespace {

struct ModuleNameDescription : ElementDescription {
    Attr<Target> module;
};

struct SetProgramDescription : ElementDescription {
    Attr<bool> setUniforms = false;
};

/// A value of a node and the uniform of the program that has its name.
struct NodeUniform {
    UniformHandle uniform;
    UniformValue value;
    const Ref<Texture>* texture = nullptr; ///< of samplers
};

UniformKind kindOf(NodeValue::Type type) {
    switch (type) {
    case NodeValue::Type::floats:
        return UniformKind::float32;
    case NodeValue::Type::doubles:
        return UniformKind::float64;
    case NodeValue::Type::integers:
        return UniformKind::int32;
    case NodeValue::Type::unsignedIntegers:
        return UniformKind::uint32;
    case NodeValue::Type::booleans:
        return UniformKind::boolean;
    case NodeValue::Type::sampler:
        return UniformKind::sampler;
    }
    return UniformKind::none;
}

NodeUniform nodeUniform(const NodeValue& value, UniformHandle uniform) {
    NodeUniform result{uniform, {}, nullptr};
    if (value.type == NodeValue::Type::sampler) {
        result.texture = &value.texture;
        return result;
    }
    const UniformType* const type = findUniformType(kindOf(value.type), 1, value.components);
    result.value = UniformValue(*type);
    for (int i = 0; i < value.components; ++i)
        result.value.setComponent(i, value.value[i]);
    return result;
}

class SetProgramTask : public FrameTask {
public:
    SetProgramTask(Ref<Program> program, std::vector<NodeUniform> uniforms, SceneManager& scene)
        : FrameTask("SetProgram")
        , program_(std::move(program))
        , uniforms_(std::move(uniforms))
        , scene_(scene) {}

    bool run() override {
        scene_.drawState().program = program_.get();
        for (const NodeUniform& u : uniforms_) {
            if (u.texture)
                u.uniform.set(std::shared_ptr<const Texture>(u.texture->shared()));
            else
                u.uniform.set(u.value);
        }
        return true;
    }

private:
    Ref<Program> program_;
    std::vector<NodeUniform> uniforms_;
    SceneManager& scene_;
};

class SetProgram : public SceneTask {
public:
    explicit SetProgram(const SetProgramDescription& d)
        : setUniforms_(d.setUniforms)
        , place_(d.place) {
        for (const Child& child : d.children) {
            if (auto* module = child.as<ModuleNameDescription>())
                modules_.push_back(module->module);
        }
    }

    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        std::string name;
        bool complete = true;
        for (const Attr<Target>& module : modules_) {
            const Ref<Module> found = findModule(module, context);
            complete &= static_cast<bool>(found);
            name += found.name + ";";
        }
        if (!complete) return nullptr;
        Ref<Program> program = context.resource<Program>(name, place_);
        if (!program) return nullptr;
        std::vector<NodeUniform> uniforms;
        if (setUniforms_) {
            for (const auto& [id, value] : context.owner().values) {
                if (value.type == NodeValue::Type::sampler && !value.texture) continue;
                uniforms.push_back(nodeUniform(value, program->find(id)));
            }
        }
        return makeStep<SetProgramTask>(std::move(program), std::move(uniforms), context.scene());
    }

private:
    bool setUniforms_;
    Place place_;
    std::vector<Attr<Target>> modules_;
};

} // namespace

Ref<Module> findModule(const Attr<Target>& name, BindContext& context) {
    SceneNode* const node = context.nodeOf(name);
    if (!node) return context.resourceOf<Module>(name);
    const auto module = node->modules.find(name->name);
    if (module != node->modules.end()) return module->second;
    context.reportMissing(name, *node, "module", node->modules);
    return {};
}

void declareSetProgram(Registry& registry) {
    using M = ModuleNameDescription;
    const ElementDeclaration& module =
        registry.element<M>("module", "A module of the program; the order counts.")
            .attribute("name", &M::module,
                       "the module: by its key at a node, such as 'this.material', or its own name")
            .required()
            .declaration();
    using D = SetProgramDescription;
    registry
        .resource<SetProgram, D, SceneTask>("setProgram",
                                            "Links modules and makes them the current program.")
        .example(R"(<setProgram setUniforms="true">
    <module name="weather"/>
    <module name="this.material"/>
</setProgram>)")
        .attribute("setUniforms", &D::setUniforms,
                   "whether the values of the node, its uniforms, are handed to the program")
        .child(module, 1)
        .build([](const D& d, BuildContext&) { return std::make_shared<SetProgram>(d); });
}

} // namespace terrane
