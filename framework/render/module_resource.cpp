// SPDX-License-Identifier: BSD-3-Clause
#include "render/module_resource.h"

#include "core/text.h"
#include "render/glsl_tokens.h"
#include "render/initial_uniform_elements.h"
#include "render/module.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"

namespace terrane {

namespace {

struct ModuleElement : ElementDescription {
    Attr<int> version = 330;
    Attr<DataFile> source;
    Attr<DataFile> vertex, tessControl, tessEvaluation, geometry, fragment;
    Attr<std::vector<std::string>> options;
    Attr<std::string> feedback;
    Attr<std::vector<std::string>> varyings;

    // In the order of ShaderStage.
    std::array<const Attr<DataFile>*, kShaderStageCount> stages() const {
        return {&vertex, &tessControl, &tessEvaluation, &geometry, &fragment};
    }
};

void check(const ModuleElement& d, Diagnostics& diagnostics) {
    bool separate = false;
    for (const Attr<DataFile>* file : d.stages()) {
        separate = separate || file->given;
        if (file->given && d.source.given)
            diagnostics.warning("unused-attribute", file->place,
                                "the file of a stage has no effect beside a source for all stages",
                                "'source', or files for stages");
    }
    if (!d.source.given && !separate)
        diagnostics.error("missing-attribute", d.place, "<module> has no file",
                          "'source', or at least one of 'vertex', 'tessControl', "
                          "'tessEvaluation', 'geometry' and 'fragment'");
    if (d.feedback.given && !d.varyings.given)
        diagnostics.error("missing-attribute", d.place,
                          "<module> with feedback needs the attribute 'varyings'");
    if (d.feedback.given && *d.feedback != "interleaved" && *d.feedback != "separate") {
        diagnostics.report({.severity = Severity::warning,
                            .code = "unknown-word",
                            .place = d.feedback.place,
                            .message = inQuotes(*d.feedback) + " counts as 'separate'",
                            .expected = "'interleaved' or 'separate'",
                            .suggestion = nearestName(*d.feedback, {"interleaved", "separate"})});
    }
    if (d.varyings.given && !d.feedback.given)
        diagnostics.warning("unused-attribute", d.varyings.place,
                            "varyings have no effect without 'feedback'");
}

// Includes are looked up in the search folders, not beside the including file. The library's error
// for a missing one is left out: the expansion tells it better.
GlslFiles includesOf(BuildContext& context) {
    return {.find = [&context](const std::string& name,
                               const Place& place) -> std::shared_ptr<const SourceFile> {
                Diagnostics lookUp;
                const auto path = context.manager().library().findFile(name, place, lookUp);
                for (const Diagnostic& d : lookUp.all()) {
                    if (d.severity != Severity::error) context.diagnostics().report(d);
                }
                if (!path) return nullptr;
                context.addFile(name, *path, significantGlsl);
                return context.manager().library().source(*path);
            },
            .namesNear =
                [&context](const std::string& name) {
                    return context.manager().library().searchPath().namesNear(name);
                }};
}

bool readFiles(const ModuleElement& d, BuildContext& context, ModuleSource& source) {
    if (d.source.given) {
        source.file = context.readSource(d.source->name, d.source.place, significantGlsl);
        return source.file != nullptr;
    }
    bool good = true;
    for (std::size_t i = 0; i < kShaderStageCount; ++i) {
        const Attr<DataFile>& file = *d.stages()[i];
        if (!file.given) continue;
        source.stageFiles[i] = context.readSource(file->name, file.place, significantGlsl);
        good = good && source.stageFiles[i];
    }
    return good;
}

std::shared_ptr<Module> build(const ModuleElement& d, BuildContext& context) {
    ModuleSource source{.name = context.name(),
                        .place = d.place,
                        .version = d.version,
                        .versionPlace = d.version.given ? d.version.place : d.place,
                        .options = *d.options,
                        .optionsPlace = d.options.given ? d.options.place : d.place,
                        .file = {},
                        .stageFiles = {},
                        .includes = includesOf(context),
                        .uniforms = {},
                        .subroutines = {},
                        .feedback = {}};
    if (!readFiles(d, context, source)) return nullptr;
    for (const Child& child : d.children) {
        if (auto initial = initialUniform(child)) source.uniforms.push_back(std::move(*initial));
        if (auto initial = initialSubroutine(child))
            source.subroutines.push_back(std::move(*initial));
    }
    if (d.feedback.given)
        source.feedback = Feedback{.mode = *d.feedback == "interleaved" ? FeedbackMode::interleaved
                                                                        : FeedbackMode::separate,
                                   .varyings = *d.varyings,
                                   .place = d.feedback.place};
    return Module::compile(context.service<GlContext>(), std::move(source), context.diagnostics());
}

} // namespace

void declareModule(Registry& registry) {
    using D = ModuleElement;
    const auto uniforms = declareInitialUniforms(registry);
    auto module = registry.resource<Module, D>(
        "module", "GLSL of one or more stages, with initial values of its uniforms.");
    module
        .example(
            R"(<module name="groundModule" version="330" source="ground.glsl" options="SNOW,LAYERS 3">
    <uniform1f name="snowLine" x="2250"/>
    <uniform3f name="sun" x="0.3" y="-0.74" z="0.4"/>
    <uniformSampler name="rock" texture="rock.png"/>
</module>)")
        .attribute("version", &D::version, "version of GLSL, such as 330")
        .required()
        .attribute("source", &D::source,
                   "file of all stages: a stage exists if the text mentions its macro, _VERTEX_, "
                   "_TESS_CONTROL_, _TESS_EVAL_, _GEOMETRY_ or _FRAGMENT_, which is defined while "
                   "the stage is compiled")
        .attribute("vertex", &D::vertex, "file of the vertex stage, without 'source'")
        .attribute("tessControl", &D::tessControl, "file of the tessellation control stage")
        .attribute("tessEvaluation", &D::tessEvaluation,
                   "file of the tessellation evaluation stage")
        .attribute("geometry", &D::geometry, "file of the geometry stage")
        .attribute("fragment", &D::fragment, "file of the fragment stage")
        .attribute("options", &D::options, "macros to define: 'A,B 3' defines A, and B as 3")
        .attribute("feedback", &D::feedback,
                   "captures varyings: 'interleaved' in one buffer, any other word in one each")
        .attribute("varyings", &D::varyings, "outputs that are captured, in order")
        .check(check)
        .build(build);
    for (const ElementDeclaration* uniform : uniforms)
        module.child(*uniform);
    registry.nameInterface<Module>("module");
}

} // namespace terrane
