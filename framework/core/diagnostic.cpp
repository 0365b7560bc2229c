// SPDX-License-Identifier: BSD-3-Clause
#include "core/diagnostic.h"

#include <algorithm>

namespace terrane {

namespace {

const char* name(Severity severity) {
    switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::error: return "error";
    }
    return "error";
}

// Shows at most this much of a source line around the caret.
constexpr std::size_t kShownWidth = 160;

std::string sourceLine(const Place& place) {
    const LineColumn at = place.position();
    std::string line(place.file->line(at.line));
    std::size_t column = static_cast<std::size_t>(at.column) - 1;
    std::size_t start = 0;
    if (line.size() > kShownWidth) {
        start = column > kShownWidth / 2 ? column - kShownWidth / 2 : 0;
        line = line.substr(start, kShownWidth);
    }
    // Tabs are kept in front of the caret so that it stands under its character.
    std::string caret;
    for (std::size_t i = 0; i < column - start; ++i)
        caret += i < line.size() && line[i] == '\t' ? '\t' : ' ';
    return "    " + line + "\n    " + caret + "^\n";
}

std::string indented(const std::string& text) {
    std::string result = "    ";
    for (const char c : text) {
        result += c;
        if (c == '\n') result += "    ";
    }
    while (!result.empty() && (result.back() == ' ' || result.back() == '\n'))
        result.pop_back();
    return result + '\n';
}

bool same(const Diagnostic& a, const Diagnostic& b) {
    return a.code == b.code && a.place == b.place && a.message == b.message;
}

} // namespace

std::string toString(const Diagnostic& d) {
    std::string text;
    if (d.place) text += d.place.toString() + ": ";
    text += std::string(name(d.severity)) + ": " + d.message + " [" + d.code + "]\n";
    if (d.place) text += sourceLine(d.place);
    if (!d.expected.empty()) text += "    expected: " + d.expected + '\n';
    if (!d.suggestion.empty()) text += "    did you mean '" + d.suggestion + "'?\n";
    if (!d.detail.empty()) text += indented(d.detail);
    for (const std::string& link : d.chain)
        text += "    needed by " + link + '\n';
    return text;
}

void Diagnostics::report(Diagnostic diagnostic) {
    Listener listener;
    {
        std::lock_guard lock(mutex_);
        const auto equal = [&](const Diagnostic& d) { return same(d, diagnostic); };
        if (std::any_of(list_.begin(), list_.end(), equal)) return;
        if (diagnostic.severity == Severity::error) ++errors_;
        if (diagnostic.severity == Severity::warning) ++warnings_;
        list_.push_back(diagnostic);
        listener = listener_;
    }
    if (listener) listener(diagnostic);
}

void Diagnostics::error(std::string code, Place place, std::string message, std::string expected) {
    report({.severity = Severity::error,
            .code = std::move(code),
            .place = std::move(place),
            .message = std::move(message),
            .expected = std::move(expected)});
}

void Diagnostics::warning(std::string code, Place place, std::string message,
                          std::string expected) {
    report({.severity = Severity::warning,
            .code = std::move(code),
            .place = std::move(place),
            .message = std::move(message),
            .expected = std::move(expected)});
}

std::size_t Diagnostics::errors() const {
    std::lock_guard lock(mutex_);
    return errors_;
}

std::size_t Diagnostics::warnings() const {
    std::lock_guard lock(mutex_);
    return warnings_;
}

std::vector<Diagnostic> Diagnostics::all() const {
    std::lock_guard lock(mutex_);
    return list_;
}

void Diagnostics::clear() {
    std::lock_guard lock(mutex_);
    list_.clear();
    errors_ = warnings_ = 0;
}

void Diagnostics::onReport(Listener listener) {
    std::lock_guard lock(mutex_);
    listener_ = std::move(listener);
}

} // namespace terrane
