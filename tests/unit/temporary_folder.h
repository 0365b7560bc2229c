// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/files.h"

#include <doctest/doctest.h>

#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>
#include <unistd.h>

namespace terrane::test {

/// A folder that goes with the test.
class TemporaryFolder {
public:
    TemporaryFolder() {
        static std::atomic<int> count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("terrane-test." + std::to_string(::getpid()) + "." + std::to_string(count++));
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    /// Writes a file and the folders above it.
    std::filesystem::path file(const std::filesystem::path& name,
                               std::string_view bytes = "x") const {
        std::filesystem::create_directories((path_ / name).parent_path());
        REQUIRE(writeFile(path_ / name, bytes));
        return path_ / name;
    }
    std::filesystem::path folder(const std::filesystem::path& name) const {
        std::filesystem::create_directories(path_ / name);
        return path_ / name;
    }
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

} // namespace terrane::test
