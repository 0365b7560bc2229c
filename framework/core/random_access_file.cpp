// SPDX-License-Identifier: BSD-3-Clause
#include "core/random_access_file.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace terrane {

std::unique_ptr<RandomAccessFile> RandomAccessFile::open(const std::filesystem::path& path) {
    // A pipe would block until somebody writes.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return nullptr;
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
        ::close(descriptor);
        return nullptr;
    }
    const auto size = static_cast<std::uint64_t>(status.st_size);
    return std::unique_ptr<RandomAccessFile>(new RandomAccessFile(descriptor, size));
}

RandomAccessFile::~RandomAccessFile() {
    ::close(descriptor_);
}

bool RandomAccessFile::read(std::uint64_t offset, std::span<std::byte> out) const {
    while (!out.empty()) {
        const ssize_t count =
            ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        out = out.subspan(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
    return true;
}

} // namespace terrane
