// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"

#include "temporary_folder.h"

#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <unistd.h>

using namespace terrane;
using terrane::test::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE("a file holds what was written") {
    const TemporaryFolder folder;
    const std::string bytes("\0\r\n\xff text", 9);
    CHECK(readFile(folder.file("a", bytes)) == bytes);
    CHECK(readFile(folder.file("a", "shorter")) == "shorter");
    CHECK(readFile(folder.file("empty", "")) == "");
    const auto count = std::distance(fs::directory_iterator(folder.path()), {});
    CHECK(count == 2); // nothing else was left behind
}

TEST_CASE("what is no readable file gives nothing") {
    const TemporaryFolder folder;
    CHECK_FALSE(readFile(folder.path()));
    CHECK_FALSE(readFile(folder.path() / "missing"));
    CHECK_FALSE(readFile(""));
    CHECK_FALSE(readFile("/dev/zero"));
    CHECK_FALSE(readFile(folder.file("a") / "below a file"));
    CHECK_FALSE(writeFile(folder.path() / "missing" / "a", "x"));
    CHECK_FALSE(writeFile(folder.path(), "x"));
}

TEST_CASE("names that leave the folders are told") {
    struct Row {
        const char* name;
        bool leaves;
    };
    const Row rows[] = {
        {"a", false},      {"a/b", false},      {"a\\b", false},       {"..a", false},
        {"a..b/c", false}, {"./a", false},      {"/etc/passwd", true}, {"..", true},
        {"../a", true},    {"a/../../b", true}, {"a/..", true},        {"..\\a", true},
        {"\\a", true},     {"C:\\a", true},     {"c:a", true},         {"", false},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK(SearchPath::leavesFolders(row.name) == row.leaves);
    }
}

TEST_CASE("a name is found in the first folder that has it") {
    const TemporaryFolder folder;
    folder.file("one/a.xml");
    folder.file("one/Deep/Texture.PNG");
    folder.file("two/a.xml");
    folder.file("two/b.xml");
    folder.file("two/A.XML");
    folder.file("secret");
    SearchPath paths;
    paths.add(folder.path() / "missing");
    paths.add(folder.path() / "one");
    paths.add(folder.path() / "two");
    paths.add(folder.path() / "one");
    CHECK(paths.folders().size() == 3);

    struct Row {
        const char* name;
        const char* path; // empty when it must not be found
        bool caseDiffers;
    };
    const Row rows[] = {
        {"a.xml", "one/a.xml", false},
        {"b.xml", "two/b.xml", false},
        {"./b.xml", "two/./b.xml", false},
        {"A.XML", "two/A.XML", false}, // an exact name in a later folder comes first
        {"B.xml", "two/b.xml", true},
        {"Deep/Texture.PNG", "one/Deep/Texture.PNG", false},
        {"Deep\\Texture.PNG", "one/Deep/Texture.PNG", false},
        {"deep/texture.png", "one/Deep/Texture.PNG", true},
        {"Deep", "", false},
        {"", "", false},
        {"../secret", "", false},
        {"Deep/../../secret", "", false},
        {"/etc/passwd", "", false},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const auto found = paths.find(row.name);
        REQUIRE(found.has_value() == (*row.path != '\0'));
        if (!found) continue;
        CHECK(found->path == folder.path() / row.path);
        CHECK(found->caseDiffers == row.caseDiffers);
    }
    CHECK_FALSE(paths.find(std::string_view("a.xml\0.png", 10)));
    CHECK_FALSE(paths.find(std::string(100000, 'a')));
    CHECK_FALSE(SearchPath().find("a.xml"));
}

TEST_CASE("names near a wrong one are those of its folder") {
    const TemporaryFolder folder;
    folder.file("one/a.xml");
    folder.file("one/deep/b.xml");
    SearchPath paths;
    paths.add(folder.path() / "one");
    std::vector<std::string> names = paths.namesNear("x.xml");
    std::sort(names.begin(), names.end());
    CHECK(names == std::vector<std::string>{"a.xml", "deep"});
    CHECK(paths.namesNear("deep/x.xml") == std::vector<std::string>{"deep/b.xml"});
    CHECK(paths.namesNear("../x").empty());
    CHECK(paths.namesNear("nowhere/x").empty());
}

TEST_CASE("paths are shown relative to the working directory where that is shorter") {
    CHECK(shownPath(fs::current_path() / "a" / "b.xml") == "a/b.xml");
    CHECK(shownPath("/a") == "/a");
    CHECK(shownPath("a/b") == "a/b");
}

TEST_CASE("the home folder is where the resources are") {
    const fs::path home = homeFolder();
    CHECK(fs::exists(home / "resources" / "terrane-resources"));
    CHECK(fs::exists(home / "archives"));
    ::setenv("TERRANE_HOME", "/elsewhere", 1);
    CHECK(homeFolder() == "/elsewhere");
    ::unsetenv("TERRANE_HOME");
    CHECK(homeFolder() == home);
}
