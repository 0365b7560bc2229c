// SPDX-License-Identifier: BSD-3-Clause
#include "render/unmatched_uniforms.h"

#include "core/text.h"
#include "render/glsl_legacy.h"
#include "render/glsl_tokens.h"
#include "render/module.h"
#include "render/program.h"
#include "resource/manager.h"

#include <algorithm>
#include <map>
#include <set>

namespace terrane {

namespace {

using Words = std::set<std::string, std::less<>>;
constexpr std::string_view kPaste = "##";

/// The identifiers of modules, each scanned once.
class Texts {
public:
    const Words& wordsOf(const Module& module) {
        const auto [known, isNew] = words_.try_emplace(&module);
        if (!isNew) return known->second;
        for (const ShaderStage stage : kShaderStages) {
            const GlslText* const text = module.text(stage);
            if (!text) continue;
            for (const GlslToken& token : scanGlsl(text->text())) {
                if (token.kind == GlslToken::Kind::identifier)
                    known->second.insert(originalGlslName(token.text));
                if (token.text == "#" && token.directive != "#") known->second.emplace(kPaste);
            }
        }
        return known->second;
    }

    bool mention(const Module& module, std::string_view name) {
        const Words& words = wordsOf(module);
        return words.contains(name) || words.contains(kPaste); // of pasted names, any
    }

    // The module, or one that it is linked with.
    bool mentionLinked(const Module& module, std::string_view name) {
        if (mention(module, name)) return true;
        const auto& programs = module.programs();
        return std::any_of(programs.begin(), programs.end(), [&](const Program* program) {
            const auto& modules = program->modules();
            return std::any_of(modules.begin(), modules.end(),
                               [&](const auto& linked) { return mention(*linked, name); });
        });
    }

private:
    std::map<const Module*, Words> words_;
};

// `fog` and `tint` of `fog.tint`, `views` of `views[3]`.
std::vector<std::string_view> identifiersOf(std::string_view name) {
    std::vector<std::string_view> result;
    for (std::size_t i = 0; i < name.size();) {
        if (!isGlslIdentifierPart(name[i])) {
            ++i;
            continue;
        }
        std::size_t end = i;
        while (end < name.size() && isGlslIdentifierPart(name[end]))
            ++end;
        if (isGlslIdentifierStart(name[i])) result.push_back(name.substr(i, end - i));
        i = end;
    }
    return result;
}

bool isAmong(const std::vector<std::string>& names, const std::vector<std::string_view>& name) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& other) {
        const auto identifiers = identifiersOf(other);
        return !name.empty() && !identifiers.empty() && identifiers.back() == name.back();
    });
}

std::vector<std::string> activeUniforms(const Module& module) {
    std::set<std::string> names;
    for (const Program* program : module.programs()) {
        for (std::string& name : program->uniformNames())
            names.insert(std::move(name));
    }
    return {names.begin(), names.end()};
}

void check(const Module& module, Texts& texts, Diagnostics& diagnostics) {
    const std::vector<std::string> active = activeUniforms(module);
    for (const InitialUniform& initial : module.uniforms()) {
        const auto identifiers = identifiersOf(initial.name);
        if (isAmong(active, identifiers)) continue; // the texts need not be looked at
        const bool mentioned =
            std::all_of(identifiers.begin(), identifiers.end(),
                        [&](std::string_view name) { return texts.mentionLinked(module, name); });
        if (mentioned) continue;
        diagnostics.report({.severity = Severity::warning,
                            .code = "unmatched-uniform",
                            .place = initial.place,
                            .message = "no program with module " + inQuotes(module.name()) +
                                       " has a uniform " + inQuotes(initial.name),
                            .expected = "the name of a uniform; without one, the value is lost",
                            .suggestion = nearestName(initial.name, active)});
    }
}

} // namespace

void reportUnmatchedUniforms(ResourceManager& manager) {
    Texts texts;
    for (const auto& [name, entry] : manager.entries()) {
        const auto* const module = dynamic_cast<const Module*>(entry->instance.get());
        if (!module || module->uniforms().empty() || module->programs().empty()) continue;
        check(*module, texts, manager.diagnostics());
    }
}

void reportUnmatchedValues(ResourceManager& manager, const std::vector<NamedValue>& values) {
    std::vector<const Module*> modules;
    std::set<std::string> names;
    for (const auto& [name, entry] : manager.entries()) {
        const auto* const module = dynamic_cast<const Module*>(entry->instance.get());
        if (!module) continue;
        modules.push_back(module);
        for (std::string& uniform : activeUniforms(*module))
            names.insert(std::move(uniform));
    }
    const std::vector<std::string> active(names.begin(), names.end());
    Texts texts;
    std::map<std::string, bool> matched; // nodes mostly have the same
    for (const NamedValue& value : values) {
        const auto [known, isNew] = matched.try_emplace(value.name);
        const auto isMentioned = [&](std::string_view identifier) {
            return std::any_of(modules.begin(), modules.end(), [&](const Module* module) {
                return texts.mention(*module, identifier);
            });
        };
        if (isNew) {
            const auto identifiers = identifiersOf(value.name);
            known->second = isAmong(active, identifiers) ||
                            std::all_of(identifiers.begin(), identifiers.end(), isMentioned);
        }
        if (known->second) continue;
        manager.diagnostics().report(
            {.severity = Severity::warning,
             .code = "unmatched-uniform",
             .place = value.place,
             .message = "no program has a uniform " + inQuotes(value.name),
             .expected = "the name of a uniform; without one, the value is lost",
             .suggestion = nearestName(value.name, active)});
    }
}

} // namespace terrane
