// SPDX-License-Identifier: BSD-3-Clause
#include "core/zip_file.h"

#include "core/diagnostic.h"
#include "core/files.h"
#include "core/text.h"
#include "core/zip_directory.h"
#include "core/zip_judge.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <zlib.h>

namespace terrane {

namespace {

constexpr std::size_t kChunk = 64 << 10;

/// Unpacks piece by piece, and stops at the first byte too many.
class Unpacking {
public:
    explicit Unpacking(const ZipFile::Entry& entry)
        : entry_(entry) {
        good_ = !entry.deflated || inflateInit2(&stream_, -MAX_WBITS) == Z_OK; // no zlib header
    }
    ~Unpacking() {
        if (entry_.deflated) inflateEnd(&stream_);
    }
    Unpacking(const Unpacking&) = delete;
    Unpacking& operator=(const Unpacking&) = delete;

    /// False when the bytes are damaged.
    bool add(std::span<const std::byte> packed) {
        if (!good_) return false;
        if (!entry_.deflated) return append(packed);
        // zlib takes no const; it does not write.
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(packed.data()));
        stream_.avail_in = static_cast<uInt>(packed.size());
        std::array<std::byte, kChunk> out;
        do {
            if (ended_) return stream_.avail_in == 0;
            stream_.next_out = reinterpret_cast<Bytef*>(out.data());
            stream_.avail_out = out.size();
            const int status = inflate(&stream_, Z_NO_FLUSH);
            if (!append(std::span(out).first(out.size() - stream_.avail_out))) return false;
            ended_ = status == Z_STREAM_END;
            if (status == Z_BUF_ERROR) return true; // it wants more
            if (status != Z_OK && !ended_) return false;
        } while (stream_.avail_in > 0 || stream_.avail_out == 0);
        return true;
    }

    bool complete() const { return ended_ || !entry_.deflated; }
    std::uint32_t checksum() const { return checksum_; }
    std::string& bytes() { return bytes_; }

private:
    bool append(std::span<const std::byte> piece) {
        if (piece.size() > entry_.size - bytes_.size()) return false;
        const auto* const begin = reinterpret_cast<const Bytef*>(piece.data());
        if (!piece.empty())
            checksum_ = static_cast<std::uint32_t>(
                crc32(checksum_, begin, static_cast<uInt>(piece.size())));
        bytes_.append(reinterpret_cast<const char*>(piece.data()), piece.size());
        return true;
    }

    const ZipFile::Entry& entry_;
    z_stream stream_{};
    std::string bytes_;
    std::uint32_t checksum_ = 0;
    bool ended_ = false;
    bool good_ = false;
};

std::string withSlash(std::string_view folder) {
    return folder.empty() ? std::string() : std::string(folder) + '/';
}

} // namespace

ZipFile::ZipFile(std::unique_ptr<RandomAccessFile> file, std::filesystem::path path,
                 std::vector<Entry> entries)
    : file_(std::move(file))
    , path_(std::move(path))
    , entries_(std::move(entries)) {}

std::shared_ptr<const ZipFile> ZipFile::open(const std::filesystem::path& path,
                                             Diagnostics& diagnostics) {
    auto file = RandomAccessFile::open(path);
    if (file) return open(std::move(file), path, diagnostics);
    diagnostics.error("file-unreadable", {}, "can't read " + inQuotes(shownPath(path)));
    return nullptr;
}

std::shared_ptr<const ZipFile> ZipFile::open(std::unique_ptr<RandomAccessFile> file,
                                             const std::filesystem::path& path,
                                             Diagnostics& diagnostics) {
    const std::string name = shownPath(path);
    std::string problem;
    const auto directory = readZipDirectory(*file, kMostEntries, problem);
    if (!directory) {
        diagnostics.error("zip-damaged", {}, inQuotes(name) + " is refused: " + problem,
                          "a whole zip");
        return nullptr;
    }
    if (directory->entries > kMostEntries) {
        diagnostics.error("zip-too-large", {},
                          inQuotes(name) + " is refused: it has " +
                              std::to_string(directory->entries) + " entries",
                          "at most " + std::to_string(kMostEntries));
        return nullptr;
    }
    Diagnostics faults;
    std::vector<Entry> entries = judgeZip(*file, *directory, name, faults);
    for (Diagnostic& fault : faults.all())
        diagnostics.report(std::move(fault));
    if (faults.errors() > 0) return nullptr;
    return std::shared_ptr<const ZipFile>(new ZipFile(std::move(file), path, std::move(entries)));
}

const ZipFile::Entry* ZipFile::find(std::string_view name) const {
    const auto found = std::ranges::lower_bound(entries_, name, {}, &Entry::name);
    return found != entries_.end() && found->name == name ? &*found : nullptr;
}

bool ZipFile::isFolder(std::string_view name) const {
    const std::string prefix = withSlash(name);
    const auto first = std::ranges::lower_bound(entries_, prefix, {}, &Entry::name);
    return name.empty() || (first != entries_.end() && first->name.starts_with(prefix));
}

std::vector<std::string> ZipFile::namesIn(std::string_view folder) const {
    const std::string prefix = withSlash(folder);
    std::vector<std::string> names;
    for (auto entry = std::ranges::lower_bound(entries_, prefix, {}, &Entry::name);
         entry != entries_.end() && entry->name.starts_with(prefix); ++entry) {
        const std::string_view rest = std::string_view(entry->name).substr(prefix.size());
        names.emplace_back(rest.substr(0, rest.find('/')));
    }
    // 'a/x' and 'a/y' may stand around 'a-b'.
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::optional<std::string> ZipFile::read(const Entry& entry, std::string& problem) const {
    Unpacking unpacking(entry);
    std::array<std::byte, kChunk> chunk;
    for (std::uint64_t done = 0; done < entry.packedSize;) {
        const auto count = std::min<std::uint64_t>(chunk.size(), entry.packedSize - done);
        const auto piece = std::span(chunk).first(static_cast<std::size_t>(count));
        if (!file_->read(entry.begin + done, piece)) {
            problem = "the zip was cut short";
            return std::nullopt;
        }
        if (!unpacking.add(piece)) {
            problem = "its bytes in the zip are damaged";
            return std::nullopt;
        }
        done += count;
    }
    if (!unpacking.complete() || unpacking.bytes().size() != entry.size) {
        problem = "it is cut short in the zip";
        return std::nullopt;
    }
    if (unpacking.checksum() != entry.checksum) {
        problem = "its bytes in the zip are damaged: their checksum is wrong";
        return std::nullopt;
    }
    return std::move(unpacking.bytes());
}

std::unique_ptr<RandomAccessFile> ZipFile::openEntry(const Entry& entry,
                                                     std::string& problem) const {
    if (!entry.deflated) return file_->part(entry.begin, entry.packedSize);
    auto bytes = read(entry, problem);
    return bytes ? RandomAccessFile::ofBytes(std::move(*bytes)) : nullptr;
}

} // namespace terrane
