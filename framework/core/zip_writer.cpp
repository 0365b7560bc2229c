// SPDX-License-Identifier: BSD-3-Clause
#include "core/zip_writer.h"

#include "core/random_access_file.h"
#include "core/text.h"

#include <algorithm>
#include <deque>
#include <span>
#include <zip.h>

namespace terrane {

namespace {

/// 1980-01-01, the first day that zips know (APPNOTE.TXT 4.4.6).
constexpr zip_uint16_t kFirstDay = 1 << 5 | 1;
/// A regular file that all may read, as Unix writes it.
constexpr zip_uint32_t kAttributes = 0100644U << 16;

/// What libzip asks for the bytes of a file, which is open only while they are read.
class Source {
public:
    Source(const std::filesystem::path& path, const FileTree& files)
        : path_(path)
        , files_(files) {
        zip_error_init(&error_);
    }
    ~Source() { zip_error_fini(&error_); }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    static zip_int64_t answer(void* source, void* data, zip_uint64_t size,
                              zip_source_cmd_t command) {
        return static_cast<Source*>(source)->answer(data, size, command);
    }
    bool failed() const { return failed_; }
    const std::filesystem::path& path() const { return path_; }

private:
    zip_int64_t answer(void* data, zip_uint64_t size, zip_source_cmd_t command) {
        switch (command) {
        case ZIP_SOURCE_OPEN:
            file_ = files_.open(path_);
            done_ = 0;
            return file_ ? 0 : fail(ZIP_ER_OPEN);
        case ZIP_SOURCE_READ:
            return read(static_cast<std::byte*>(data), size);
        case ZIP_SOURCE_CLOSE:
            file_.reset();
            return 0;
        case ZIP_SOURCE_STAT:
            return stat(static_cast<zip_stat_t*>(data));
        case ZIP_SOURCE_ERROR:
            return zip_error_to_data(&error_, data, size);
        case ZIP_SOURCE_FREE:
            return 0;
        case ZIP_SOURCE_SUPPORTS:
            return zip_source_make_command_bitmap(ZIP_SOURCE_OPEN, ZIP_SOURCE_READ,
                                                  ZIP_SOURCE_CLOSE, ZIP_SOURCE_STAT,
                                                  ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, -1);
        default:
            zip_error_set(&error_, ZIP_ER_OPNOTSUPP, 0);
            return -1;
        }
    }

    zip_int64_t read(std::byte* out, zip_uint64_t size) {
        const zip_uint64_t count = std::min<zip_uint64_t>(size, file_->size() - done_);
        if (!file_->read(done_, std::span(out, static_cast<std::size_t>(count))))
            return fail(ZIP_ER_READ);
        done_ += count;
        return static_cast<zip_int64_t>(count);
    }

    zip_int64_t stat(zip_stat_t* out) {
        const auto file = files_.open(path_);
        if (!file) return fail(ZIP_ER_OPEN);
        zip_stat_init(out);
        out->size = file->size();
        out->valid |= ZIP_STAT_SIZE;
        return sizeof *out;
    }

    zip_int64_t fail(int code) {
        failed_ = true;
        zip_error_set(&error_, code, 0);
        return -1;
    }

    const std::filesystem::path& path_;
    const FileTree& files_;
    std::unique_ptr<RandomAccessFile> file_;
    zip_uint64_t done_ = 0;
    zip_error_t error_{};
    bool failed_ = false;
};

bool add(zip_t* zip, const ZipContent& content, Source& source) {
    zip_source_t* const bytes = zip_source_function(zip, Source::answer, &source);
    if (!bytes) return false;
    const zip_int64_t added = zip_file_add(zip, content.name.c_str(), bytes, ZIP_FL_ENC_UTF_8);
    if (added < 0) {
        zip_source_free(bytes);
        return false;
    }
    const auto index = static_cast<zip_uint64_t>(added);
    const zip_int32_t method = content.stored ? ZIP_CM_STORE : ZIP_CM_DEFLATE;
    return zip_set_file_compression(zip, index, method, 0) == 0 &&
           zip_file_set_dostime(zip, index, 0, kFirstDay, 0) == 0 &&
           zip_file_set_external_attributes(zip, index, 0, ZIP_OPSYS_UNIX, kAttributes) == 0;
}

/// Empty when it was written.
std::string write(const std::filesystem::path& path, const std::vector<ZipContent>& contents,
                  const FileTree& files) {
    int code = 0;
    zip_t* const zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    if (!zip) {
        zip_error_t error;
        zip_error_init_with_code(&error, code);
        std::string problem = zip_error_strerror(&error);
        zip_error_fini(&error);
        return problem;
    }
    std::deque<Source> sources; // stay where they are until libzip has read them
    bool good = true;
    for (const ZipContent& content : contents) {
        good = good && add(zip, content, sources.emplace_back(content.path, files));
    }
    if (good && zip_close(zip) == 0) return {};
    std::string problem = zip_strerror(zip);
    for (const Source& source : sources) {
        if (source.failed()) problem = "can't read " + inQuotes(source.path().string());
    }
    zip_discard(zip);
    return problem;
}

} // namespace

bool writeZip(const std::filesystem::path& path, const std::vector<ZipContent>& contents,
              const FileTree& files, std::string& problem) {
    // libzip itself writes beside the path and renames.
    problem = write(path, contents, files);
    return problem.empty();
}

} // namespace terrane
