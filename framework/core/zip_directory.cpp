// SPDX-License-Identifier: BSD-3-Clause
#include "core/zip_directory.h"

#include "core/random_access_file.h"

#include <algorithm>
#include <span>
#include <string_view>

namespace terrane {

namespace {

// Names of the fields and their places: APPNOTE.TXT 4.3.7, 4.3.12, 4.3.14, 4.3.15, 4.3.16, 4.5.3.
constexpr std::uint32_t kLocalHeader = 0x04034b50;
constexpr std::uint32_t kCentralHeader = 0x02014b50;
constexpr std::uint32_t kEnd = 0x06054b50;
constexpr std::uint32_t kEnd64 = 0x06064b50;
constexpr std::uint32_t kLocator64 = 0x07064b50;
constexpr std::size_t kLocalBytes = 30;
constexpr std::size_t kCentralBytes = 46;
constexpr std::size_t kEndBytes = 22;
constexpr std::size_t kEnd64Bytes = 56;
constexpr std::size_t kLocatorBytes = 20;
constexpr std::size_t kLongestComment = 0xffff;
constexpr std::uint16_t kFields64 = 1; ///< the extra field with sizes of more than 32 bits
constexpr std::uint32_t kIn64 = ~0U;   ///< the value is there
constexpr std::uint8_t kUnix = 3;      ///< who made an entry
constexpr std::uint8_t kMac = 19;      ///< has Unix' modes, too
/// Of the directory; it is read into memory at once.
constexpr std::uint64_t kLargestDirectory = 64 << 20;

constexpr const char* kCut = "it is cut short";

std::uint64_t number(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = count; i-- > 0;)
        value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    return value;
}
std::uint16_t u16(std::string_view bytes, std::size_t at) {
    return static_cast<std::uint16_t>(number(bytes, at, 2));
}
std::uint32_t u32(std::string_view bytes, std::size_t at) {
    return static_cast<std::uint32_t>(number(bytes, at, 4));
}
std::uint64_t u64(std::string_view bytes, std::size_t at) {
    return number(bytes, at, 8);
}

/// Nothing when they are not all there.
std::optional<std::string> bytesAt(const RandomAccessFile& file, std::uint64_t offset,
                                   std::uint64_t count) {
    if (offset > file.size() || count > file.size() - offset) return std::nullopt;
    std::string bytes(static_cast<std::size_t>(count), '\0');
    if (!file.read(offset, std::as_writable_bytes(std::span(bytes)))) return std::nullopt;
    return bytes;
}

/// What the record at the end says.
struct End {
    std::uint64_t entries = 0, size = 0, begin = 0;
    std::uint64_t end = 0; ///< where the directory has to end
    bool oneDisk = true;
};

/// The record at the end, behind which there is only its comment.
std::optional<std::uint64_t> findEnd(const RandomAccessFile& file) {
    const std::uint64_t count = std::min<std::uint64_t>(file.size(), kEndBytes + kLongestComment);
    const auto tail = bytesAt(file, file.size() - count, count);
    if (!tail || tail->size() < kEndBytes) return std::nullopt;
    for (std::size_t i = tail->size() - kEndBytes + 1; i-- > 0;) {
        if (u32(*tail, i) == kEnd && u16(*tail, i + 20) == tail->size() - kEndBytes - i)
            return file.size() - count + i;
    }
    return std::nullopt;
}

/// The record of large zips, if there is one. False when it is damaged.
bool readEnd64(const RandomAccessFile& file, End& end) {
    if (end.end < kLocatorBytes) return true;
    const std::uint64_t locatorAt = end.end - kLocatorBytes;
    const auto locator = bytesAt(file, locatorAt, kLocatorBytes);
    if (!locator) return false;
    if (u32(*locator, 0) != kLocator64) return true;
    const std::uint64_t at = u64(*locator, 8);
    const auto record = bytesAt(file, at, kEnd64Bytes);
    if (!record || u32(*record, 0) != kEnd64) return false;
    // What the size counts begins 12 bytes into the record, which the locator follows.
    if (at > locatorAt || locatorAt - at < kEnd64Bytes || u64(*record, 4) != locatorAt - at - 12)
        return false;
    end = {.entries = u64(*record, 32),
           .size = u64(*record, 40),
           .begin = u64(*record, 48),
           .end = at,
           .oneDisk = u32(*record, 16) == 0 && u32(*record, 20) == 0 && u32(*locator, 4) == 0 &&
                      u64(*record, 24) == u64(*record, 32)};
    return true;
}

std::optional<End> readEnd(const RandomAccessFile& file, std::string& problem) {
    const auto at = findEnd(file);
    const auto record = at ? bytesAt(file, *at, kEndBytes) : std::nullopt;
    if (!record) {
        const auto start = bytesAt(file, 0, 2);
        problem = start && *start == "PK" ? kCut : "it is no zip";
        return std::nullopt;
    }
    End end{.entries = u16(*record, 10),
            .size = u32(*record, 12),
            .begin = u32(*record, 16),
            .end = *at,
            .oneDisk = u16(*record, 4) == 0 && u16(*record, 6) == 0 &&
                       u16(*record, 8) == u16(*record, 10)};
    if (!readEnd64(file, end)) {
        problem = "its zip64 record is damaged";
        return std::nullopt;
    }
    if (!end.oneDisk) {
        problem = "it is one part of several";
        return std::nullopt;
    }
    if (end.begin > end.end || end.size != end.end - end.begin) {
        problem = "its directory is not where its end says";
        return std::nullopt;
    }
    return end;
}

/// Takes the values of more than 32 bits from the extra fields. False when they are damaged.
bool readFields64(std::string_view extra, ZipRecord& record) {
    while (extra.size() >= 4) {
        const std::uint16_t id = u16(extra, 0);
        const std::size_t size = u16(extra, 2);
        if (size > extra.size() - 4) return false;
        std::string_view field = extra.substr(4, size);
        extra.remove_prefix(4 + size);
        if (id != kFields64) continue;
        for (std::uint64_t* const value : {&record.size, &record.packedSize, &record.header}) {
            if (*value != kIn64) continue;
            if (field.size() < 8) return false;
            *value = u64(field, 0);
            field.remove_prefix(8);
        }
        return true;
    }
    return true;
}

/// The record that some bytes begin with, which are taken. Nothing when it is damaged.
std::optional<ZipRecord> takeRecord(std::string_view& bytes) {
    if (bytes.size() < kCentralBytes || u32(bytes, 0) != kCentralHeader) return std::nullopt;
    const std::size_t name = u16(bytes, 28), extra = u16(bytes, 30), comment = u16(bytes, 32);
    if (name + extra + comment > bytes.size() - kCentralBytes) return std::nullopt;
    ZipRecord record{.name = std::string(bytes.substr(kCentralBytes, name)),
                     .flags = u16(bytes, 8),
                     .method = u16(bytes, 10),
                     .checksum = u32(bytes, 16),
                     .packedSize = u32(bytes, 20),
                     .size = u32(bytes, 24),
                     .header = u32(bytes, 42),
                     .disk = u16(bytes, 34)};
    const auto system = static_cast<std::uint8_t>(bytes[5]);
    if (system == kUnix || system == kMac) record.unixMode = u16(bytes, 40);
    if (!readFields64(bytes.substr(kCentralBytes + name, extra), record)) return std::nullopt;
    bytes.remove_prefix(kCentralBytes + name + extra + comment);
    return record;
}

} // namespace

std::optional<ZipDirectory> readZipDirectory(const RandomAccessFile& file, std::size_t most,
                                             std::string& problem) {
    const auto end = readEnd(file, problem);
    if (!end) return std::nullopt;
    ZipDirectory directory{.records = {}, .entries = end->entries, .begin = end->begin};
    if (end->entries > most) return directory;
    if (end->size > kLargestDirectory) {
        problem = "its directory has " + std::to_string(end->size) + " bytes, more than " +
                  std::to_string(kLargestDirectory);
        return std::nullopt;
    }
    const auto bytes = bytesAt(file, end->begin, end->size);
    if (!bytes) {
        problem = kCut;
        return std::nullopt;
    }
    std::string_view rest = *bytes;
    for (std::uint64_t i = 0; i < end->entries; ++i) {
        auto record = takeRecord(rest);
        if (!record) {
            problem = "entry " + std::to_string(i + 1) + " of its directory is damaged";
            return std::nullopt;
        }
        directory.records.push_back(std::move(*record));
    }
    if (!rest.empty()) {
        problem = "its directory has more than the " + std::to_string(end->entries) +
                  " entries that its end speaks of";
        return std::nullopt;
    }
    return directory;
}

std::optional<std::uint64_t> findZipData(const RandomAccessFile& file, const ZipRecord& record,
                                         std::string& problem) {
    const auto header = bytesAt(file, record.header, kLocalBytes + record.name.size());
    if (!header || u32(*header, 0) != kLocalHeader) {
        problem = "is not where the directory says";
        return std::nullopt;
    }
    const std::size_t name = u16(*header, 26), extra = u16(*header, 28);
    const bool same = name == record.name.size() &&
                      header->compare(kLocalBytes, name, record.name) == 0 &&
                      u16(*header, 8) == record.method;
    if (!same) {
        problem = "is another one than the directory says";
        return std::nullopt;
    }
    return record.header + kLocalBytes + name + extra;
}

} // namespace terrane
