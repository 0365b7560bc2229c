// SPDX-License-Identifier: BSD-3-Clause
#include "app/script_words.h"

#include "app/options.h"
#include "core/text.h"

#include <cmath>
#include <utility>

namespace terrane {

namespace {

bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

} // namespace

std::optional<std::string> ScriptWords::word() {
    if (empty()) return std::nullopt;
    return words_[next_++];
}

bool ScriptWords::literal(std::string_view text) {
    if (empty() || words_[next_] != text) return false;
    ++next_;
    return true;
}

std::optional<double> ScriptWords::real() {
    const auto text = word();
    if (!text) return std::nullopt;
    const auto number = parseReal(*text);
    if (!number || number->length != text->size() || !std::isfinite(number->value))
        return std::nullopt;
    return number->value;
}

std::optional<int> ScriptWords::count() {
    const auto text = word();
    if (!text) return std::nullopt;
    const auto number = parseInt(*text);
    if (!number || number->length != text->size() || number->value < 0) return std::nullopt;
    return number->value;
}

std::optional<View> ScriptWords::view() {
    const auto text = word();
    return text ? parseView(*text) : std::nullopt;
}

std::optional<Comparison> ScriptWords::comparison() {
    static constexpr std::pair<std::string_view, Comparison> kWords[] = {
        {"==", Comparison::equal},         {"=", Comparison::equal},
        {"!=", Comparison::notEqual},      {"<", Comparison::less},
        {"<=", Comparison::lessOrEqual},   {">", Comparison::greater},
        {">=", Comparison::greaterOrEqual}};
    for (const auto& [text, comparison] : kWords) {
        if (literal(text)) return comparison;
    }
    return std::nullopt;
}

std::optional<std::vector<std::string>> wordsOf(std::string_view text) {
    std::vector<std::string> words;
    std::size_t i = 0;
    while (true) {
        while (i < text.size() && isSpace(text[i]))
            ++i;
        if (i == text.size()) return words;
        std::string word;
        if (text[i] == '"') {
            const std::size_t end = text.find('"', i + 1);
            if (end == std::string_view::npos) return std::nullopt;
            word = text.substr(i + 1, end - i - 1);
            i = end + 1;
        } else {
            while (i < text.size() && !isSpace(text[i]))
                word += text[i++];
        }
        words.push_back(std::move(word));
    }
}

} // namespace terrane
