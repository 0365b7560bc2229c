// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"
#include "core/mapped_file.h"
#include "temporary_folder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <string>

using namespace terrane;
namespace fs = std::filesystem;

namespace {

std::string textOf(const MappedFile& file) {
    return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

} // namespace

TEST_CASE("A mapped file gives the bytes of the file, and keeps them when it is replaced") {
    test::TemporaryFolder folder;
    const fs::path path = folder.file("a.dat", "first");
    const auto file = MappedFile::open(path);
    REQUIRE(file);
    CHECK(textOf(*file) == "first");
    CHECK(writeFile(path, "second one"));
    CHECK(textOf(*file) == "first");
    CHECK(file->covers(5));
    CHECK_FALSE(file->covers(6));
}

TEST_CASE("A mapped file that is cut short in place says so") {
    test::TemporaryFolder folder;
    const fs::path path = folder.file("a.dat", std::string(10000, 'x'));
    const auto file = MappedFile::open(path);
    REQUIRE(file);
    CHECK(file->covers(10000));
    fs::resize_file(path, 100);
    CHECK_FALSE(file->covers(101));
    CHECK(file->covers(100));
}

TEST_CASE("What is no regular file is not mapped") {
    test::TemporaryFolder folder;
    const auto empty = MappedFile::open(folder.file("empty.dat", ""));
    REQUIRE(empty);
    CHECK(empty->size() == 0);
    CHECK_FALSE(MappedFile::open(folder.path() / "missing.dat"));
    CHECK_FALSE(MappedFile::open(folder.path()));
}
