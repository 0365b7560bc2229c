// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace terrane {

/// A regular file, a piece of one, or bytes in memory, read in pieces: what is never asked for is
/// never read, and what was asked for once stays in the system's cache. Any thread may read,
/// several at a time.
///
/// Not mapped into memory on purpose: a mapped byte ends the program (SIGBUS) when somebody cuts
/// the file short while it is looked at, and no check before the look can rule that out. Copying
/// the bytes of a tile costs little beside decoding them.
///
/// Replacing the file (writing beside it and renaming) changes nothing here: the old one is read.
class RandomAccessFile {
public:
    /// Null when the file can't be read (missing, a directory, no permission).
    static std::unique_ptr<RandomAccessFile> open(const std::filesystem::path& path);
    static std::unique_ptr<RandomAccessFile> ofBytes(std::string bytes);
    ~RandomAccessFile();
    RandomAccessFile(const RandomAccessFile&) = delete;
    RandomAccessFile& operator=(const RandomAccessFile&) = delete;

    /// A piece of this one, which must have it, as a file of its own that may outlive this one.
    std::unique_ptr<RandomAccessFile> part(std::uint64_t begin, std::uint64_t size) const;

    /// In bytes, when the file was opened.
    std::uint64_t size() const { return size_; }

    /// Fills all of `out` with the bytes from an offset on; false when they are not all there (the
    /// file was cut short) or can't be read.
    bool read(std::uint64_t offset, std::span<std::byte> out) const;

private:
    struct Bytes; ///< an open file, or memory

    RandomAccessFile(std::shared_ptr<const Bytes> bytes, std::uint64_t begin, std::uint64_t size);

    const std::shared_ptr<const Bytes> bytes_;
    const std::uint64_t begin_;
    const std::uint64_t size_;
};

} // namespace terrane
