// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace terrane::test {

/// An entry of a zip that is written byte by byte, so that it can say what no tool writes.
struct ZipPiece {
    std::string name;
    std::string bytes;
    bool deflated = false;
    /// Instead of what is true.
    std::optional<std::uint16_t> method;
    std::optional<std::uint32_t> checksum;
    std::optional<std::uint64_t> size, packedSize, header;
    std::optional<std::string> localName;
    std::uint16_t flags = 0;
    std::uint32_t unixMode = 0100644;
    std::uint16_t disk = 0;
    bool in64 = false;  ///< sizes and offset in the field of large zips
    std::string packed; ///< instead of the packed bytes
};

/// Of the whole zip, instead of what is true.
struct ZipEnds {
    std::optional<std::uint64_t> entries;
    std::int64_t beginShift = 0; ///< of where the directory is said to begin
    bool in64 = false;           ///< with the record of large zips
    std::uint64_t size64Shift = 0;
    std::string comment;
    std::string before; ///< bytes before the first entry
};

/// The bytes without zlib's header and checksum.
std::string deflated(const std::string& bytes);
std::uint32_t checksumOf(const std::string& bytes);

std::string zipBytes(const std::vector<ZipPiece>& pieces, const ZipEnds& ends = {});

} // namespace terrane::test
