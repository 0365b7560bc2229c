// SPDX-License-Identifier: BSD-3-Clause
#include "core/zip_judge.h"

#include "core/diagnostic.h"
#include "core/text.h"
#include "core/zip_directory.h"

#include <algorithm>
#include <map>

namespace terrane {

namespace {

constexpr std::uint16_t kStored = 0, kDeflated = 8;
// Flags of APPNOTE.TXT 4.4.4: encrypted, strongly encrypted, with a masked directory.
constexpr std::uint16_t kEncrypted = 1 << 0 | 1 << 6 | 1 << 13;
// Types of Unix' modes.
constexpr std::uint32_t kTypeMask = 0170000, kRegular = 0100000, kFolder = 0040000, kLink = 0120000;
/// More faults than these tell nothing new.
constexpr std::size_t kMostFaults = 20;

bool isUtf8(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    for (std::size_t i = 0; i < text.size();) {
        const std::uint8_t first = byte(i);
        const std::size_t length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
        if ((first >= 0x80 && first < 0xc2) || first > 0xf4) return false;
        if (length > text.size() - i) return false;
        std::uint32_t code = length == 1 ? first : first & (0x7f >> length);
        for (std::size_t k = 1; k < length; ++k) {
            if ((byte(i + k) & 0xc0) != 0x80) return false;
            code = code << 6 | (byte(i + k) & 0x3f);
        }
        // Longer than it needs to be, half of a pair of UTF-16, or beyond the last.
        if (length == 3 && (code < 0x800 || (code >= 0xd800 && code < 0xe000))) return false;
        if (length == 4 && (code < 0x10000 || code > 0x10ffff)) return false;
        i += length;
    }
    return true;
}

/// Why a name is refused; empty when it is fine. The '/' behind the name of a folder is gone.
std::string nameProblem(std::string_view name) {
    if (name.empty()) return "is empty";
    if (name.size() > ZipFile::kLongestName)
        return "is longer than " + std::to_string(ZipFile::kLongestName) + " bytes";
    if (!isUtf8(name)) return "is no UTF-8";
    const auto control = [](char c) { return static_cast<std::uint8_t>(c) < 0x20 || c == 0x7f; };
    if (std::any_of(name.begin(), name.end(), control)) return "has control characters";
    if (name.find('\\') != std::string_view::npos) return "has a backslash";
    if (name.starts_with('/')) return "is absolute";
    if (name.find(':') != std::string_view::npos) return "has a colon, as drives have";
    for (const std::string_view part : split(name, '/')) {
        if (part.empty()) return "has an empty part";
        if (part == "." || part == "..") return "has a part '" + std::string(part) + "'";
    }
    return name.ends_with('/') ? "has an empty part" : std::string();
}

std::string lowered(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return text;
}

class Judge {
public:
    Judge(const RandomAccessFile& file, const ZipDirectory& directory, const std::string& name,
          Diagnostics& diagnostics)
        : file_(file)
        , directory_(directory)
        , name_(name)
        , diagnostics_(diagnostics) {}

    std::vector<ZipFile::Entry> entries() {
        for (const ZipRecord& record : directory_.records)
            judge(record);
        judgeSum();
        judgeOverlaps();
        if (faults_ > 0) return {};
        std::sort(entries_.begin(), entries_.end(),
                  [](const auto& a, const auto& b) { return a.name < b.name; });
        return std::move(entries_);
    }

private:
    struct Range {
        std::uint64_t begin = 0, end = 0;
        const ZipRecord* record = nullptr;
    };

    void fault(const char* code, const std::string& text, std::string expected = {}) {
        if (++faults_ <= kMostFaults)
            diagnostics_.error(code, {}, inQuotes(name_) + ": " + text, std::move(expected));
    }
    void fault(const char* code, const ZipRecord& record, const std::string& text,
               std::string expected = {}) {
        fault(code, "entry " + inQuotes(record.name) + " " + text, std::move(expected));
    }

    void judge(const ZipRecord& record) {
        std::string name = record.name;
        const bool folder = name.ends_with('/');
        if (folder) name.pop_back();
        const std::string problem = nameProblem(name);
        if (!problem.empty()) {
            return fault("zip-unsafe-name", record, "is refused: its name " + problem,
                         "a name relative to the zip, such as 'textures/grass.png'");
        }
        if (!judgeNames(name, folder, record) || !judgeKind(record, folder)) return;
        if (folder) return;
        if (record.method != kStored && record.method != kDeflated) {
            return fault("zip-method", record,
                         "is packed by method " + std::to_string(record.method) +
                             ", which is not known here",
                         "deflated or stored entries");
        }
        if (!judgeSizes(record)) return;
        std::string missing;
        const auto begin = findZipData(file_, record, missing);
        if (!begin) return fault("zip-damaged", record, missing);
        if (*begin > directory_.begin || record.packedSize > directory_.begin - *begin)
            return fault("zip-damaged", record, "goes on behind the end of all entries");
        ranges_.push_back({record.header, *begin + record.packedSize, &record});
        entries_.push_back({.name = record.name,
                            .size = record.size,
                            .packedSize = record.packedSize,
                            .begin = *begin,
                            .checksum = record.checksum,
                            .deflated = record.method == kDeflated});
    }

    /// Every name, and every folder that it speaks of, is one thing, whatever its case.
    bool judgeNames(const std::string& name, bool folder, const ZipRecord& record) {
        for (std::size_t end = name.find('/'); end != std::string::npos;
             end = name.find('/', end + 1)) {
            if (!addName(name.substr(0, end), true, record)) return false;
        }
        return addName(name, folder, record);
    }
    bool addName(const std::string& name, bool folder, const ZipRecord& record) {
        const auto [known, isNew] = names_.try_emplace(lowered(name), Name{name, folder});
        if (isNew) return true;
        const Name& first = known->second;
        if (folder && first.folder && first.name == name) return true;
        fault("zip-duplicate-name", record,
              first.name == name
                  ? (folder == first.folder ? "is there twice" : "is a file and a folder")
                  : "differs from " + inQuotes(first.name) + " only in its case",
              "one entry of each name, whatever the case");
        return false;
    }

    bool judgeKind(const ZipRecord& record, bool folder) {
        const std::uint32_t type = record.unixMode & kTypeMask;
        if (type != 0 && type != (folder ? kFolder : kRegular)) {
            fault("zip-special-file", record,
                  type == kLink ? "is a symbolic link" : "is neither a file nor a folder",
                  "the file itself");
            return false;
        }
        if ((record.flags & kEncrypted) != 0) {
            fault("zip-encrypted", record, "is encrypted", "a zip without a password");
            return false;
        }
        if (record.disk != 0) {
            fault("zip-damaged", record, "is in another part of the zip");
            return false;
        }
        return true;
    }

    bool judgeSizes(const ZipRecord& record) {
        if (record.method == kStored) {
            if (record.size == record.packedSize) return true;
            fault("zip-damaged", record, "is not packed, and yet has two sizes");
            return false;
        }
        unpacked_ += std::min(record.size, ZipFile::kMostUnpacked); // without overflow
        if (record.size > ZipFile::kLargestUnpacked) {
            fault("zip-too-large", record, "unpacks to " + std::to_string(record.size) + " bytes",
                  "at most " + std::to_string(ZipFile::kLargestUnpacked) +
                      ", or an entry that is stored, not deflated");
            return false;
        }
        const bool small = record.size <= ZipFile::kSmall;
        if (small || record.size / ZipFile::kMostRatio <= record.packedSize) return true;
        fault("zip-too-large", record,
              "unpacks to " + std::to_string(record.size) + " bytes from " +
                  std::to_string(record.packedSize) + ", as bombs do",
              "at most " + std::to_string(ZipFile::kMostRatio) +
                  " times as many, or an entry that is stored, not deflated");
        return false;
    }

    void judgeSum() {
        if (unpacked_ <= ZipFile::kMostUnpacked) return;
        fault("zip-too-large",
              "its entries unpack to more than " + std::to_string(ZipFile::kMostUnpacked) +
                  " bytes",
              "less, or entries that are stored, not deflated");
    }

    /// Entries that share bytes make small zips of huge contents.
    void judgeOverlaps() {
        std::sort(ranges_.begin(), ranges_.end(),
                  [](const Range& a, const Range& b) { return a.begin < b.begin; });
        for (std::size_t i = 1; i < ranges_.size(); ++i) {
            if (ranges_[i - 1].end > ranges_[i].begin)
                fault("zip-damaged", *ranges_[i].record,
                      "shares bytes with " + inQuotes(ranges_[i - 1].record->name));
        }
    }

    struct Name {
        std::string name;
        bool folder = false;
    };

    const RandomAccessFile& file_;
    const ZipDirectory& directory_;
    const std::string& name_;
    Diagnostics& diagnostics_;
    std::vector<ZipFile::Entry> entries_;
    std::vector<Range> ranges_;
    std::map<std::string, Name> names_; ///< by their lower case
    std::uint64_t unpacked_ = 0;
    std::size_t faults_ = 0;
};

} // namespace

std::vector<ZipFile::Entry> judgeZip(const RandomAccessFile& file, const ZipDirectory& directory,
                                     const std::string& name, Diagnostics& diagnostics) {
    return Judge(file, directory, name, diagnostics).entries();
}

} // namespace terrane
