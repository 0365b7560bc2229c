// SPDX-License-Identifier: BSD-3-Clause
#include "render/glsl_text.h"

#include <algorithm>

namespace terrane {

void GlslText::append(const std::shared_ptr<const SourceFile>& file, std::size_t offset,
                      std::size_t length) {
    if (length == 0) return;
    pieces_.push_back({text_.size(), {file, offset}, true});
    text_.append(file->text(), offset, length);
}

void GlslText::append(std::string_view text, const Place& place) {
    if (text.empty()) return;
    pieces_.push_back({text_.size(), place, false});
    text_ += text;
}

void GlslText::append(const GlslText& other) {
    appendSlice(other, 0, other.text_.size());
}

void GlslText::appendIncluded(const GlslText& other, const Place& place) {
    const std::size_t begin = text_.size();
    append(other);
    inclusions_.push_back({begin, text_.size(), place});
}

void GlslText::appendSlice(const GlslText& other, std::size_t begin, std::size_t end) {
    if (begin >= end) return;
    const std::size_t target = text_.size();
    for (std::size_t i = other.pieceAt(begin); i < other.pieces_.size(); ++i) {
        Piece piece = other.pieces_[i];
        if (piece.begin >= end) break;
        if (piece.begin < begin) {
            if (piece.verbatim) piece.place.offset += begin - piece.begin;
            piece.begin = begin;
        }
        piece.begin += target - begin;
        pieces_.push_back(std::move(piece));
    }
    for (const Inclusion& inclusion : other.inclusions_) {
        const std::size_t first = std::max(begin, inclusion.begin);
        const std::size_t last = std::min(end, inclusion.end);
        if (first < last)
            inclusions_.push_back({first - begin + target, last - begin + target, inclusion.place});
    }
    text_.append(other.text_, begin, end - begin);
}

std::size_t GlslText::pieceAt(std::size_t offset) const {
    const auto after = [](std::size_t at, const Piece& piece) { return at < piece.begin; };
    const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), offset, after);
    return next == pieces_.begin() ? 0 : static_cast<std::size_t>(next - pieces_.begin()) - 1;
}

Place GlslText::place(std::size_t offset) const {
    if (pieces_.empty()) return {};
    const Piece& piece = pieces_[pieceAt(offset)];
    Place place = piece.place;
    if (piece.verbatim) place.offset += std::min(offset, text_.size()) - piece.begin;
    return place;
}

std::vector<Place> GlslText::inclusions(std::size_t offset) const {
    std::vector<const Inclusion*> around;
    for (const Inclusion& inclusion : inclusions_) {
        if (inclusion.begin <= offset && offset < inclusion.end) around.push_back(&inclusion);
    }
    std::stable_sort(around.begin(), around.end(), [](const Inclusion* a, const Inclusion* b) {
        return a->end - a->begin < b->end - b->begin;
    });
    std::vector<Place> places;
    for (const Inclusion* inclusion : around)
        places.push_back(inclusion->place);
    return places;
}

std::size_t GlslText::lineStart(int line) const {
    std::size_t offset = 0;
    for (int i = 1; i < line; ++i) {
        const std::size_t end = text_.find('\n', offset);
        if (end == std::string::npos) return text_.size();
        offset = end + 1;
    }
    return offset;
}

GlslText GlslText::edited(const std::vector<Edit>& edits) const {
    GlslText result;
    std::size_t done = 0;
    for (const Edit& edit : edits) {
        result.appendSlice(*this, done, edit.offset);
        result.append(edit.text, place(edit.offset));
        done = edit.offset + edit.length;
    }
    result.appendSlice(*this, done, text_.size());
    return result;
}

} // namespace terrane
