// SPDX-License-Identifier: BSD-3-Clause
#include "core/file_stamp.h"

#include "core/zip_file.h"

#include <chrono>
#include <functional>

namespace terrane {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMostDigested = 64 << 20;
// Longer than the steps of any file system's times but FAT's.
constexpr auto kClockStep = std::chrono::seconds(1);

} // namespace

std::optional<FileStamp::Status> FileStamp::statusOf(const fs::path& path, const FileTree& files) {
    std::error_code error;
    Status status;
    if (const auto name = files.nameInZip(path)) {
        const ZipFile::Entry* const entry = files.zip()->find(*name);
        if (!entry) return std::nullopt;
        status.size = entry->size;
        status.checksum = entry->checksum;
        return status;
    }
    status.size = fs::file_size(path, error);
    if (error) return std::nullopt;
    status.written = fs::last_write_time(path, error);
    return error ? std::nullopt : std::optional(status);
}

std::optional<std::size_t> FileStamp::digestOf(const fs::path& path, const FileTree& files,
                                               const std::optional<Status>& status) const {
    if (!status || status->size > kMostDigested) return std::nullopt;
    if (!significant_ && files.nameInZip(path)) return std::nullopt; // the checksum tells
    const auto bytes = files.read(path);
    if (!bytes) return std::nullopt;
    const std::hash<std::string_view> hash;
    return significant_ ? hash(significant_(*bytes)) : hash(*bytes);
}

FileStamp FileStamp::of(const fs::path& path, Significant significant, const FileTree& files) {
    FileStamp stamp;
    stamp.significant_ = significant;
    stamp.status_ = statusOf(path, files);
    stamp.digest_ = stamp.digestOf(path, files, stamp.status_);
    const bool timed = !files.nameInZip(path);
    stamp.fresh_ = timed && stamp.status_ &&
                   fs::file_time_type::clock::now() - stamp.status_->written < kClockStep;
    return stamp;
}

bool FileStamp::differs(const fs::path& path, const FileTree& files) const {
    const auto status = statusOf(path, files);
    if (status == status_ && !fresh_) return false;
    if (!status || !status_) return status.has_value() != status_.has_value();
    const auto digest = digestOf(path, files, status);
    if (!digest && !digest_) return status != status_;
    return digest != digest_;
}

} // namespace terrane
