// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace terrane {

class RandomAccessFile;

/// What the central directory of a zip says about an entry (APPNOTE.TXT 4.3.12), not yet judged.
struct ZipRecord {
    std::string name;
    std::uint16_t flags = 0;
    std::uint16_t method = 0;
    std::uint32_t checksum = 0;
    std::uint64_t packedSize = 0;
    std::uint64_t size = 0;
    std::uint64_t header = 0; ///< offset of its local header
    std::uint32_t disk = 0;
    /// Type and permissions of the file as Unix has them; 0 when another system wrote the entry.
    std::uint32_t unixMode = 0;
};

struct ZipDirectory {
    std::vector<ZipRecord> records; ///< none where there are too many
    std::uint64_t entries = 0;      ///< as its end says
    std::uint64_t begin = 0;        ///< of the directory itself: all entries lie before
};

/// Reads the central directory of any bytes, zip64 included. Strict: it has to end where the record
/// of its end begins, and hold exactly the entries that this speaks of. Nothing, with the reason,
/// when it is damaged. Of more than `most` entries none is read.
std::optional<ZipDirectory> readZipDirectory(const RandomAccessFile& file, std::size_t most,
                                             std::string& problem);

/// Where the bytes of an entry begin, behind its local header (APPNOTE.TXT 4.3.7). Nothing, with
/// the reason, when there is no header that agrees with the record.
std::optional<std::uint64_t> findZipData(const RandomAccessFile& file, const ZipRecord& record,
                                         std::string& problem);

} // namespace terrane
