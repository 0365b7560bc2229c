// SPDX-License-Identifier: BSD-3-Clause
#include "core/random_access_file.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace terrane {

struct RandomAccessFile::Bytes {
    explicit Bytes(int file)
        : descriptor(file) {}
    explicit Bytes(std::string bytes)
        : memory(std::move(bytes)) {}
    ~Bytes() {
        if (descriptor >= 0) ::close(descriptor);
    }
    Bytes(const Bytes&) = delete;
    Bytes& operator=(const Bytes&) = delete;

    const int descriptor = -1; ///< negative: memory
    const std::string memory;
};

RandomAccessFile::RandomAccessFile(std::shared_ptr<const Bytes> bytes, std::uint64_t begin,
                                   std::uint64_t size)
    : bytes_(std::move(bytes))
    , begin_(begin)
    , size_(size) {}

RandomAccessFile::~RandomAccessFile() = default;

std::unique_ptr<RandomAccessFile> RandomAccessFile::open(const std::filesystem::path& path) {
    // A pipe would block until somebody writes.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return nullptr;
    auto bytes = std::make_shared<const Bytes>(descriptor);
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return nullptr;
    const auto size = static_cast<std::uint64_t>(status.st_size);
    return std::unique_ptr<RandomAccessFile>(new RandomAccessFile(std::move(bytes), 0, size));
}

std::unique_ptr<RandomAccessFile> RandomAccessFile::ofBytes(std::string bytes) {
    const std::uint64_t size = bytes.size();
    return std::unique_ptr<RandomAccessFile>(
        new RandomAccessFile(std::make_shared<const Bytes>(std::move(bytes)), 0, size));
}

std::unique_ptr<RandomAccessFile> RandomAccessFile::part(std::uint64_t begin,
                                                         std::uint64_t size) const {
    assert(begin <= size_ && size <= size_ - begin && "RandomAccessFile::part(): outside");
    return std::unique_ptr<RandomAccessFile>(new RandomAccessFile(bytes_, begin_ + begin, size));
}

bool RandomAccessFile::read(std::uint64_t offset, std::span<std::byte> out) const {
    if (offset > size_ || out.size() > size_ - offset) return false;
    offset += begin_;
    if (bytes_->descriptor < 0) {
        const auto memory = std::as_bytes(std::span(bytes_->memory));
        std::ranges::copy(memory.subspan(static_cast<std::size_t>(offset), out.size()),
                          out.begin());
        return true;
    }
    while (!out.empty()) {
        const ssize_t count =
            ::pread(bytes_->descriptor, out.data(), out.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        out = out.subspan(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
    return true;
}

} // namespace terrane
