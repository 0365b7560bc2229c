// SPDX-License-Identifier: BSD-3-Clause
#include "core/source.h"

#include <algorithm>

namespace terrane {

SourceFile::SourceFile(std::string path, std::string text)
    : path_(std::move(path))
    , text_(std::move(text))
    , lineStarts_{text_.starts_with("\xef\xbb\xbf") ? 3u : 0u} {
    for (std::size_t i = 0; i < text_.size(); ++i) {
        if (text_[i] == '\n') lineStarts_.push_back(i + 1);
    }
}

LineColumn SourceFile::position(std::size_t offset) const {
    offset = std::clamp(offset, lineStarts_.front(), text_.size());
    const auto next = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), offset);
    const auto line = static_cast<int>(next - lineStarts_.begin());
    return {line, static_cast<int>(offset - lineStarts_[line - 1]) + 1};
}

std::size_t SourceFile::offset(LineColumn position) const {
    if (position.line < 1) return lineStarts_.front();
    if (position.line > static_cast<int>(lineStarts_.size())) return text_.size();
    const std::size_t start = lineStarts_[position.line - 1];
    const std::size_t column = position.column > 0 ? position.column - 1 : 0;
    return start + std::min(column, line(position.line).size());
}

std::string_view SourceFile::line(int number) const {
    if (number < 1 || number > static_cast<int>(lineStarts_.size())) return {};
    const std::size_t start = lineStarts_[number - 1];
    const bool last = number == static_cast<int>(lineStarts_.size());
    std::size_t end = last ? text_.size() : lineStarts_[number] - 1;
    if (end > start && text_[end - 1] == '\r') --end;
    return std::string_view(text_).substr(start, end - start);
}

std::string Place::toString() const {
    if (!file) return {};
    const LineColumn at = position();
    return file->path() + ':' + std::to_string(at.line) + ':' + std::to_string(at.column);
}

Place relocated(const Place& place, const std::shared_ptr<const SourceFile>& now) {
    if (!place.file || !now || place.file == now) return place;
    const std::string &before = place.file->text(), &after = now->text();
    const std::size_t shorter = std::min(before.size(), after.size());
    const auto firstDifference = std::mismatch(
        before.begin(), before.begin() + static_cast<std::ptrdiff_t>(shorter), after.begin());
    const auto same = static_cast<std::size_t>(firstDifference.first - before.begin());
    if (place.offset < same || before == after) return {now, place.offset};
    const std::size_t behind = before.size() - std::min(place.offset, before.size());
    std::size_t common = 0; // from the end
    while (common < shorter - same &&
           before[before.size() - 1 - common] == after[after.size() - 1 - common])
        ++common;
    if (behind > 0 && behind <= common) return {now, after.size() - behind};
    return place;
}

} // namespace terrane
