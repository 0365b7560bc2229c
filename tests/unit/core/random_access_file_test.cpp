// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"
#include "core/random_access_file.h"
#include "temporary_folder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <limits>
#include <span>
#include <string>

using namespace terrane;
namespace fs = std::filesystem;

namespace {

// "-" when they are not all there.
std::string textOf(const RandomAccessFile& file, std::uint64_t offset, std::size_t count) {
    std::string text(count, '?');
    return file.read(offset, std::as_writable_bytes(std::span(text))) ? text : "-";
}

} // namespace

TEST_CASE("A file is read in pieces, and stays what it was when it is replaced") {
    test::TemporaryFolder folder;
    const fs::path path = folder.file("a.dat", "first");
    const auto file = RandomAccessFile::open(path);
    REQUIRE(file);
    CHECK(writeFile(path, "second one"));
    CHECK(file->size() == 5);
    CHECK(textOf(*file, 0, 5) == "first");
    CHECK(textOf(*file, 2, 2) == "rs");
    CHECK(textOf(*file, 5, 0).empty());
    CHECK(textOf(*file, 0, 6) == "-");
    CHECK(textOf(*file, 5, 1) == "-");
    CHECK(textOf(*file, std::numeric_limits<std::uint64_t>::max(), 1) == "-");
}

TEST_CASE("A file that is cut short in place gives what is left of it") {
    test::TemporaryFolder folder;
    const fs::path path = folder.file("a.dat", std::string(10000, 'x'));
    const auto file = RandomAccessFile::open(path);
    REQUIRE(file);
    CHECK(textOf(*file, 9000, 1000) == std::string(1000, 'x'));
    fs::resize_file(path, 100);
    CHECK(textOf(*file, 9000, 1000) == "-");
    CHECK(textOf(*file, 0, 101) == "-");
    CHECK(textOf(*file, 0, 100) == std::string(100, 'x'));
}

TEST_CASE("What is no regular file is not read") {
    test::TemporaryFolder folder;
    const auto empty = RandomAccessFile::open(folder.file("empty.dat", ""));
    REQUIRE(empty);
    CHECK(empty->size() == 0);
    CHECK(textOf(*empty, 0, 1) == "-");
    CHECK_FALSE(RandomAccessFile::open(folder.path() / "missing.dat"));
    CHECK_FALSE(RandomAccessFile::open(folder.path()));
}
