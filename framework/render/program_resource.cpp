// SPDX-License-Identifier: BSD-3-Clause
#include "render/program_resource.h"

#include "core/files.h"
#include "core/text.h"
#include "render/program.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"

#include <cstring>

namespace terrane {

namespace {

struct ModuleReference : ElementDescription {
    Ref<Module> module;
};

struct ProgramElement : ElementDescription {};

// `a;b;.bin` in the search folders: the driver's format, and what it made (ork reference 1.4).
std::optional<ProgramBinary> findBinary(const ProgramElement& d, BuildContext& context) {
    const std::string file = (d.name.given ? *d.name : context.name()) + ".bin";
    const SearchPath& search = context.manager().library().searchPath();
    const auto found = search.find(file);
    if (!found) {
        context.addMissingFile(file);
        return std::nullopt;
    }
    context.addFile(file, found->path);
    const auto bytes = search.files().read(found->path);
    std::uint32_t format = 0;
    if (!bytes || bytes->size() <= sizeof format) {
        context.diagnostics().warning("program-binary", d.place,
                                      inQuotes(file) + " can't be read, or is too short");
        return std::nullopt;
    }
    std::memcpy(&format, bytes->data(), sizeof format);
    return ProgramBinary{.format = format, .bytes = bytes->substr(sizeof format)};
}

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
    source.binary = findBinary(d, context);
    auto program =
        Program::link(context.service<ProgramBindings>(), std::move(source), context.diagnostics());
    // Values that were set live survive a reload.
    const auto previous = context.previous<Program>();
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
        .example(R"(<program name="groundProgram">
    <module name="weather"/>
    <module name="groundModule"/>
</program>)")
        .child(module, 1)
        .build(build);
    registry.nameInterface<Program>("program");
}

} // namespace terrane
