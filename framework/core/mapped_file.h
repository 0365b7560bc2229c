// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace terrane {

/// The bytes of a regular file, mapped into memory for reading: what is never looked at is never
/// read, and what was looked at is shared with the system's cache. Immutable, so any thread may
/// read it. Replacing the file (writing beside it and renaming) leaves the mapping as it was;
/// cutting the file short in place takes bytes away, so ask covers() before a read.
class MappedFile {
public:
    /// Null when the file can't be read (missing, a directory, no permission, no address space).
    static std::unique_ptr<MappedFile> open(const std::filesystem::path& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::uint64_t size() const { return bytes_.size(); }
    std::span<const std::byte> bytes() const { return bytes_; }

    /// Whether the file on the disk still reaches to this offset. Reading a mapped byte that the
    /// disk no longer has would end the program.
    bool covers(std::uint64_t end) const;

private:
    MappedFile(int descriptor, std::span<const std::byte> bytes)
        : descriptor_(descriptor)
        , bytes_(bytes) {}

    const int descriptor_;
    const std::span<const std::byte> bytes_;
};

} // namespace terrane
