// SPDX-License-Identifier: BSD-3-Clause
#include "render/program_resource.h"

#include "render/program.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"

namespace terrane {

namespace {

struct ModuleReference : ElementDescription {
    Ref<Module> module;
};

struct ProgramElement : ElementDescription {};

std::shared_ptr<Program> build(const ProgramElement& d, BuildContext& context) {
    ProgramSource source{.name = context.name(), .place = d.place, .modules = {}};
    for (const Child& child : d.children) {
        const auto* reference = child.as<ModuleReference>();
        if (!reference) continue;
        // A missing module has been reported.
        if (!reference->module) return nullptr;
        source.modules.push_back(
            std::static_pointer_cast<Module>(reference->module.entry()->instance));
    }
    auto program =
        Program::link(context.service<ProgramBindings>(), std::move(source), context.diagnostics());
    // Values that were set live survive a reload.
    const auto previous = std::dynamic_pointer_cast<Program>(context.entry().instance);
    if (program && previous) program->inheritValues(*previous);
    return program;
}

} // namespace

void declareProgram(Registry& registry) {
    const auto& module = registry.element<ModuleReference>("module", "A module to link.")
                             .attribute("name", &ModuleReference::module, "the module")
                             .required()
                             .declaration();
    registry
        .resource<Program, ProgramElement>(
            "program", "Modules linked in order; usually written as the name 'a;b;'.")
        .child(module, 1)
        .build(build);
    registry.nameInterface<Program>("program");
}

} // namespace terrane
