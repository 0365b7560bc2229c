// SPDX-License-Identifier: BSD-3-Clause
#include "core/diagnostic.h"

#include <algorithm>

namespace terrane {

namespace {

const char* name(Severity severity) {
    switch (severity) {
    case Severity::note:
        return "note";
    case Severity::warning:
        return "warning";
    case Severity::error:
        return "error";
    }
    return "error";
}

// Shows at most this much of a source line around the caret.
constexpr std::size_t kShownWidth = 160;

bool continuesCharacter(char c) { // of UTF-8
    return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

// What a terminal would act upon is not shown.
char shown(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\t') || byte == 0x7f ? ' ' : c;
}

std::string sourceLine(const Place& place) {
    const LineColumn at = place.position();
    const std::string_view line = place.file->line(at.line);
    const std::size_t column = std::min(static_cast<std::size_t>(at.column) - 1, line.size());
    std::size_t start = 0;
    std::size_t end = line.size();
    if (line.size() > kShownWidth) {
        start = column > kShownWidth / 2 ? column - kShownWidth / 2 : 0;
        end = std::min(line.size(), start + kShownWidth);
        while (start < column && continuesCharacter(line[start]))
            ++start;
        while (end < line.size() && end > column && continuesCharacter(line[end]))
            --end;
    }
    std::string text, caret;
    for (std::size_t i = start; i < end; ++i)
        text += shown(line[i]);
    // The caret stands under its character: tabs are kept, and a character of several bytes is one.
    for (std::size_t i = start; i < column; ++i) {
        if (!continuesCharacter(line[i])) caret += line[i] == '\t' ? '\t' : ' ';
    }
    return "    " + text + "\n    " + caret + "^\n";
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

std::size_t hash(const Diagnostic& d) {
    const std::hash<std::string> text;
    const std::size_t place = std::hash<const void*>()(d.place.file.get()) ^ (d.place.offset * 31);
    return text(d.code) ^ (text(d.message) * 3) ^ (place * 7);
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
        if (relocation_ && diagnostic.place) diagnostic.place = relocation_(diagnostic.place);
        const std::size_t key = hash(diagnostic);
        const auto [first, last] = indexByHash_.equal_range(key);
        const auto equal = [&](const auto& item) { return same(list_[item.second], diagnostic); };
        if (std::any_of(first, last, equal)) return;
        indexByHash_.emplace(key, list_.size());
        if (diagnostic.severity == Severity::error) ++errors_;
        if (diagnostic.severity == Severity::warning) ++warnings_;
        list_.push_back(diagnostic);
        ++reported_;
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

std::size_t Diagnostics::size() const {
    std::lock_guard lock(mutex_);
    return list_.size();
}

std::size_t Diagnostics::reported() const {
    std::lock_guard lock(mutex_);
    return reported_;
}

std::vector<Diagnostic> Diagnostics::all() const {
    std::lock_guard lock(mutex_);
    return list_;
}

void Diagnostics::clear() {
    std::lock_guard lock(mutex_);
    list_.clear();
    indexByHash_.clear();
    errors_ = warnings_ = 0;
}

void Diagnostics::forget(std::size_t first, std::size_t last) {
    if (first >= last) return;
    std::lock_guard lock(mutex_);
    list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(std::min(first, list_.size())),
                list_.begin() + static_cast<std::ptrdiff_t>(std::min(last, list_.size())));
    countAgain();
}

std::size_t Diagnostics::forgetErrors(std::size_t index) {
    const auto isError = [](const Diagnostic& d) { return d.severity == Severity::error; };
    std::lock_guard lock(mutex_);
    const auto end = list_.begin() + static_cast<std::ptrdiff_t>(std::min(index, list_.size()));
    const auto before = std::count_if(list_.begin(), end, isError);
    std::erase_if(list_, isError);
    countAgain();
    return static_cast<std::size_t>(before);
}

void Diagnostics::countAgain() {
    indexByHash_.clear();
    errors_ = warnings_ = 0;
    for (std::size_t i = 0; i < list_.size(); ++i) {
        indexByHash_.emplace(hash(list_[i]), i);
        errors_ += list_[i].severity == Severity::error;
        warnings_ += list_[i].severity == Severity::warning;
    }
}

void Diagnostics::setRelocation(std::function<Place(const Place&)> relocation) {
    std::lock_guard lock(mutex_);
    relocation_ = std::move(relocation);
}

void Diagnostics::onReport(Listener listener) {
    std::lock_guard lock(mutex_);
    listener_ = std::move(listener);
}

} // namespace terrane
