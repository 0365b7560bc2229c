// SPDX-License-Identifier: BSD-3-Clause
#include "core/mapped_file.h"

#include <fcntl.h>
#include <optional>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace terrane {

namespace {

std::optional<std::uint64_t> regularFileSize(int descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return static_cast<std::uint64_t>(status.st_size);
}

std::optional<std::span<const std::byte>> map(int descriptor) {
    const auto size = regularFileSize(descriptor);
    if (!size) return std::nullopt;
    if (*size == 0) return std::span<const std::byte>(); // which can't be mapped
    void* const address = ::mmap(nullptr, *size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (address == MAP_FAILED) return std::nullopt;
    return std::span(static_cast<const std::byte*>(address), *size);
}

} // namespace

std::unique_ptr<MappedFile> MappedFile::open(const std::filesystem::path& path) {
    // A pipe would block until somebody writes.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return nullptr;
    const auto bytes = map(descriptor);
    if (!bytes) {
        ::close(descriptor);
        return nullptr;
    }
    return std::unique_ptr<MappedFile>(new MappedFile(descriptor, *bytes));
}

MappedFile::~MappedFile() {
    if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
    ::close(descriptor_);
}

bool MappedFile::covers(std::uint64_t end) const {
    if (end > bytes_.size()) return false;
    const auto now = regularFileSize(descriptor_);
    return now && end <= *now;
}

} // namespace terrane
