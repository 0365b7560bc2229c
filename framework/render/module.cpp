// SPDX-License-Identifier: BSD-3-Clause
#include "render/module.h"

#include "render/glsl_legacy.h"
#include "render/glsl_log.h"

#include <algorithm>
#include <utility>

namespace terrane {

namespace {

std::size_t index(ShaderStage stage) {
    return static_cast<std::size_t>(stage);
}

} // namespace

Module::Module(const GlContext& context, ModuleSource source)
    : context_(context)
    , source_(std::move(source)) {}

std::shared_ptr<Module> Module::start(const GlContext& context, ModuleSource source,
                                      Diagnostics& diagnostics) {
    std::shared_ptr<Module> module(new Module(context, std::move(source)));
    if (!module->assemble(diagnostics)) return nullptr;
    module->compileStages(diagnostics);
    return module;
}

std::shared_ptr<Module> Module::compile(const GlContext& context, ModuleSource source,
                                        Diagnostics& diagnostics) {
    auto module = start(context, std::move(source), diagnostics);
    return module && module->finish(diagnostics) ? module : nullptr;
}

bool Module::assemble(Diagnostics& diagnostics) {
    bool complete = true;
    const auto expand = [&](const std::shared_ptr<const SourceFile>& file) {
        ExpandedGlsl expanded = expandGlsl(file, source_.includes, diagnostics);
        complete = complete && expanded.complete;
        for (const auto& read : expanded.files) {
            if (std::find(files_.begin(), files_.end(), read) == files_.end())
                files_.push_back(read);
        }
        return std::move(expanded.text);
    };
    if (source_.file) {
        const GlslText text = expand(source_.file);
        for (const ShaderStage stage : kShaderStages) {
            if (mentionsStage(text, stage)) texts_[index(stage)] = text;
        }
    } else {
        for (const ShaderStage stage : kShaderStages) {
            if (const auto& file = source_.stageFiles[index(stage)])
                texts_[index(stage)] = expand(file);
        }
    }
    return complete;
}

void Module::compileStages(Diagnostics& diagnostics) {
    std::vector<LegacyChange> changes;
    for (const ShaderStage stage : kShaderStages) {
        std::optional<GlslText>& text = texts_[index(stage)];
        if (!text) continue;
        GlslHeader header{.version = source_.version,
                          .versionPlace = source_.versionPlace,
                          .options = source_.options,
                          .optionsPlace = source_.optionsPlace};
        if (source_.file) header.macro = stage;
        text = assembleStage(
            header, rewriteLegacyGlsl(*text, source_.version, stage, source_.options, changes));
        shaders_.emplace_back(context_, stage).compile(text->text());
    }
    reportLegacyGlsl(changes, diagnostics);
}

bool Module::finish(Diagnostics& diagnostics) {
    if (finished_) return good_;
    finished_ = good_ = true;
    for (const ShaderObject& shader : shaders_) {
        std::string log;
        const bool good = shader.finish(log);
        reportCompileLog(log, !good, *texts_[index(shader.stage())], stageName(shader.stage()),
                         source_.place, diagnostics);
        good_ = good_ && good;
    }
    return good_;
}

bool Module::hasStage(ShaderStage stage) const {
    return texts_[index(stage)].has_value();
}

const GlslText* Module::text(ShaderStage stage) const {
    const auto& text = texts_[index(stage)];
    return text ? &*text : nullptr;
}

} // namespace terrane
