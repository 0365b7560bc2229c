// SPDX-License-Identifier: BSD-3-Clause
#include "resource/value_grammar.h"

#include "resource/declaration.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace terrane {

namespace {

using Base = ValueForm::Base;

constexpr const char* kInteger = R"([+\-]?[0-9]+)";
constexpr const char* kReal = R"([+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?)";
// A name, or a qualified one, of neither an empty node nor the variable '$'.
constexpr const char* kTarget = R"([^.]+|([^.$][^.]*|$[^.]+)\.(.|\n|\r)+)";

// Pieces between commas; empty ones are ignored.
std::string numberList(const std::string& number) {
    const std::string piece = R"((\s*)" + number + R"(\s*)?)";
    return piece + "(," + piece + ")*";
}

std::string escaped(const std::string& word) {
    std::string result;
    for (const char c : word) {
        if (std::string(R"(\|.?*+(){}[]-^)").find(c) != std::string::npos) result += '\\';
        result += c;
    }
    return result;
}

std::string wordList(const std::vector<std::string>& words) {
    std::string any;
    for (const std::string& word : words)
        any += (any.empty() ? "" : "|") + escaped(word);
    return "(" + any + ")(,(" + any + "))*";
}

std::optional<ValueForm::Bound> bound(double value, bool excluded) {
    if (!std::isfinite(value)) return std::nullopt;
    return ValueForm::Bound{fmt::format("{}", value), excluded};
}

ValueForm number(const AttributeDeclaration& a, Base base, std::string pattern = {}) {
    return {.base = base,
            .words = {},
            .pattern = std::move(pattern),
            .minimum = bound(a.minimum, a.minimumExcluded),
            .maximum = bound(a.maximum, false)};
}

// "inf" and "infinity" in any case.
std::string infinity(const AttributeDeclaration& a) {
    const std::string word = "[iI][nN][fF]([iI][nN][iI][tT][yY])?";
    const bool above = !std::isfinite(a.maximum), below = !std::isfinite(a.minimum);
    return (above && below ? R"([+\-]?)" : above ? R"(\+?)" : "-") + word;
}

// Those that fit.
ValueForm integerForm(const AttributeDeclaration& a) {
    ValueForm form = number(a, Base::integer);
    using Limits = std::numeric_limits<int>;
    if (!form.minimum) form.minimum = {std::to_string(Limits::min())};
    if (!form.maximum) {
        form.maximum = {a.bits ? std::to_string(std::numeric_limits<unsigned>::max())
                               : std::to_string(Limits::max())};
    }
    return form;
}

std::vector<ValueForm> realForms(const AttributeDeclaration& a) {
    std::vector<ValueForm> forms{number(a, Base::real, kReal)};
    if (a.infinite) forms.push_back({.pattern = infinity(a)});
    return forms;
}

} // namespace

bool ValueForm::anyText() const {
    return base == Base::text && words.empty() && pattern.empty() && !notEmpty;
}

std::vector<ValueForm> valueForms(const AttributeDeclaration& a) {
    switch (a.kind) {
    case ValueKind::boolean:
        return {{.words = {"true", "false"}}};
    case ValueKind::integer:
        return {integerForm(a)};
    case ValueKind::real:
        return realForms(a);
    case ValueKind::enumeration:
        return {{.words = a.words}};
    case ValueKind::integerList:
        return {{.pattern = numberList(kInteger)}};
    case ValueKind::realList:
        return {{.pattern = numberList(kReal)}};
    case ValueKind::enumerationList:
        return {{.pattern = wordList(a.words)}};
    case ValueKind::reference:
        return {{.notEmpty = true}};
    case ValueKind::target:
        return {{.pattern = kTarget}};
    case ValueKind::text:
        if (a.required) return {{.notEmpty = true}};
        break;
    case ValueKind::textList:
    case ValueKind::referenceList:
    case ValueKind::file:
        break;
    }
    return {{}};
}

std::optional<std::string> writtenDefault(const ElementDeclaration& element,
                                          const AttributeDeclaration& a) {
    if (a.required || a.defaultText.empty() || !a.read) return std::nullopt;
    const auto description = element.makeDescription();
    Diagnostics problems;
    const bool good = a.read({a.defaultText, {}, {}}, *description, problems);
    if (!good || !problems.all().empty()) return std::nullopt;
    return a.defaultText;
}

} // namespace terrane
