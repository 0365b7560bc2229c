// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/source.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// Text put together from several files that remembers, byte by byte, where each part was written,
/// so that what a compiler says about it can be told in the author's file, line and column.
///
/// Positions are kept beside the text and not in `#line` directives: Mesa forgets the source-string
/// number in its semantic errors, no directive carries a column, and an include in the middle of a
/// line leaves no room for one.
class GlslText {
public:
    struct Edit {
        std::size_t offset = 0;
        std::size_t length = 0;
        std::string text;
    };

    /// Adds a part of a file as it is.
    void append(const std::shared_ptr<const SourceFile>& file, std::size_t offset,
                std::size_t length);
    /// Adds text of our own; all of it counts as written at `place`, which may be empty.
    void append(std::string_view text, const Place& place);
    /// Adds another text.
    void append(const GlslText& other);
    /// Adds another text that an `#include` at `place` asked for.
    void appendIncluded(const GlslText& other, const Place& place);

    const std::string& text() const { return text_; }
    /// Where the byte at an offset was written.
    Place place(std::size_t offset) const;
    /// The includes that brought the byte at an offset in, innermost first.
    std::vector<Place> inclusions(std::size_t offset) const;
    /// The offset of a line's first byte (lines count from 1); the end when there is no such line.
    std::size_t lineStart(int line) const;

    /// The text with some ranges replaced. Edits are sorted and don't overlap; a replacement counts
    /// as written where what it replaces stood.
    GlslText edited(const std::vector<Edit>& edits) const;

private:
    struct Piece {
        std::size_t begin = 0;
        Place place;
        bool verbatim = false;
    };
    struct Inclusion {
        std::size_t begin = 0;
        std::size_t end = 0;
        Place place;
    };

    void appendSlice(const GlslText& other, std::size_t begin, std::size_t end);
    std::size_t pieceAt(std::size_t offset) const;

    std::string text_;
    std::vector<Piece> pieces_; // sorted; each reaches to the next one's begin
    std::vector<Inclusion> inclusions_;
};

} // namespace terrane
