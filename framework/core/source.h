// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// A line and a column, both counted from 1; columns count bytes. 0 means unknown.
struct LineColumn {
    int line = 0;
    int column = 0;
};

/// The text of a file that diagnostics point into. Immutable, so any thread may read it. A byte
/// order mark at its start belongs to no line, as editors see it.
class SourceFile {
public:
    /// @param path as the author would type it, relative to the working directory
    SourceFile(std::string path, std::string text);

    const std::string& path() const { return path_; }
    const std::string& text() const { return text_; }

    /// The position of a byte offset; offsets past the end count as the end.
    LineColumn position(std::size_t offset) const;
    /// The byte offset of a position; columns past the end of the line count as its end.
    std::size_t offset(LineColumn position) const;
    /// The text of a line (from 1) without its line break; empty when there is no such line.
    std::string_view line(int number) const;

private:
    std::string path_;
    std::string text_;
    std::vector<std::size_t> lineStarts_;
};

/// A place in a file. Cheap to copy; keeps the text alive so that it can be shown later.
struct Place {
    std::shared_ptr<const SourceFile> file;
    std::size_t offset = 0;

    explicit operator bool() const { return file != nullptr; }
    LineColumn position() const { return file ? file->position(offset) : LineColumn{}; }
    /// "file:line:col", or an empty text without a file.
    std::string toString() const;

    bool operator==(const Place& other) const = default;
};

/// Where a place of a text is in a later version of it: before and after what differs, the place of
/// the same bytes. A place within what differs stays as it is, in the old text.
Place relocated(const Place& place, const std::shared_ptr<const SourceFile>& now);

} // namespace terrane
