// SPDX-License-Identifier: BSD-3-Clause
#include "render/module.h"

#include "core/text.h"
#include "render/glsl_legacy.h"
#include "render/glsl_log.h"
#include "render/glsl_tokens.h"
#include "resource/value_traits.h"

#include <algorithm>
#include <set>
#include <utility>

namespace terrane {

namespace {

std::size_t index(ShaderStage stage) {
    return static_cast<std::size_t>(stage);
}

bool hasWord(std::string_view text, std::string_view word) {
    const auto inWord = [&](std::size_t i) {
        return i < text.size() && isGlslIdentifierPart(text[i]);
    };
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string_view::npos; ++at) {
        if ((at == 0 || !inWord(at - 1)) && !inWord(at + word.size())) return true;
    }
    return false;
}

// What the texts ask for: words of #if, #ifdef and so on.
template <class Texts>
std::vector<std::string> conditionsOf(const Texts& texts) {
    std::set<std::string> names;
    for (const auto& text : texts) {
        if (!text) continue;
        for (const GlslToken& token : scanGlsl(text->text())) {
            const bool condition = token.directive.starts_with("if") || token.directive == "elif";
            if (condition && token.kind == GlslToken::Kind::identifier) names.emplace(token.text);
        }
    }
    return {names.begin(), names.end()};
}

// The name that an option defines: A of "A", "A 3" and "A(x) x".
std::string_view macroOf(std::string_view option) {
    std::size_t begin = 0;
    while (begin < option.size() && !isGlslIdentifierPart(option[begin]))
        ++begin;
    std::size_t end = begin;
    while (end < option.size() && isGlslIdentifierPart(option[end]))
        ++end;
    return option.substr(begin, end - begin);
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

// A misspelt option defines a macro that nobody asks for.
void Module::warnUnusedOptions(Diagnostics& diagnostics) const {
    detail::ValueWalker walker(source_.optionsPlace);
    for (const std::string& option : source_.options) {
        const Place place = walker.place();
        walker.advance(option.size() + 1);
        const std::string_view macro = macroOf(option);
        const auto mentions = [&](const std::optional<GlslText>& text) {
            return text && hasWord(text->text(), macro);
        };
        if (macro.empty() || std::any_of(texts_.begin(), texts_.end(), mentions)) continue;
        diagnostics.report({.severity = Severity::warning,
                            .code = "unused-option",
                            .place = place,
                            .message = "the text of module " + inQuotes(source_.name) +
                                       " does not mention " + inQuotes(macro),
                            .expected = "a macro that the text asks for",
                            .suggestion = nearestName(macro, conditionsOf(texts_))});
    }
}

void Module::compileStages(Diagnostics& diagnostics) {
    warnUnusedOptions(diagnostics);
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
