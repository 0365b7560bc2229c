// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/random_access_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

class Diagnostics;

/// A zip whose entries are read where they lie: nothing is extracted to disk. Immutable, so any
/// thread may read.
///
/// Takes any bytes, as it may come from anybody. Refused as a whole, each fault with a diagnostic:
/// - "zip-damaged": no zip, cut short, entries that overlap or are not where the directory says;
/// - "zip-unsafe-name": absolute, with "..", ".", an empty part, a drive, a backslash, a control
///   character, what is no UTF-8, or longer than kLongestName;
/// - "zip-duplicate-name": the same twice, also if only the case differs (other systems take that
///   for one), or a file and a folder of one name;
/// - "zip-special-file": symbolic links and whatever else is neither file nor folder;
/// - "zip-encrypted", "zip-method": what can't be read: neither stored nor deflated;
/// - "zip-too-large": more entries or bytes than the limits below: a bomb.
/// What is wrong with the bytes of one entry (its checksum, its size) is told when it is read.
///
/// Has its own reader, since libzip, which writes our zips, tells nobody where the bytes of an
/// entry lie, and lets one thread at a time read.
class ZipFile {
public:
    static constexpr std::size_t kMostEntries = 20'000;
    static constexpr std::size_t kLongestName = 1'000; ///< bytes
    /// What deflated entries unpack to at most, each and all together. Stored ones are as large as
    /// they are.
    static constexpr std::uint64_t kLargestUnpacked = std::uint64_t(1) << 30;
    static constexpr std::uint64_t kMostUnpacked = std::uint64_t(4) << 30;
    /// Of a deflated entry to what it unpacks to, where that is more than kSmall: texts reach 20,
    /// zeros 1030.
    static constexpr std::uint64_t kMostRatio = 200;
    static constexpr std::uint64_t kSmall = 1 << 20;

    struct Entry {
        std::string name; ///< its parts are separated by '/'
        std::uint64_t size = 0;
        std::uint64_t packedSize = 0;
        std::uint64_t begin = 0;    ///< of its bytes in the zip
        std::uint32_t checksum = 0; ///< CRC-32 of what it unpacks to, as the zip says
        bool deflated = false;
    };

    /// Null, with diagnostics that have no place, when it is refused.
    static std::shared_ptr<const ZipFile> open(const std::filesystem::path& path,
                                               Diagnostics& diagnostics);
    /// The same of a file that is open; the path is for messages and for FileTree.
    static std::shared_ptr<const ZipFile> open(std::unique_ptr<RandomAccessFile> file,
                                               const std::filesystem::path& path,
                                               Diagnostics& diagnostics);

    const std::filesystem::path& path() const { return path_; }
    /// All files, sorted by name. Folders are told by the names alone.
    const std::vector<Entry>& entries() const { return entries_; }
    /// Null when there is no such file.
    const Entry* find(std::string_view name) const;
    bool isFolder(std::string_view name) const; ///< "" is
    /// Names of the files and folders in a folder, sorted.
    std::vector<std::string> namesIn(std::string_view folder) const;

    /// All bytes of an entry. Nothing, with the reason, when they are damaged. Takes memory for
    /// what is there, whatever the entry says of its size.
    std::optional<std::string> read(const Entry& entry, std::string& problem) const;
    /// To be read in pieces: in place when it is stored, which proves no checksum; unpacked into
    /// memory when it is deflated. May outlive the zip.
    std::unique_ptr<RandomAccessFile> openEntry(const Entry& entry, std::string& problem) const;

private:
    ZipFile(std::unique_ptr<RandomAccessFile> file, std::filesystem::path path,
            std::vector<Entry> entries);

    std::unique_ptr<RandomAccessFile> file_;
    std::filesystem::path path_;
    std::vector<Entry> entries_;
};

} // namespace terrane
