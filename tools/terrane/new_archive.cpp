// SPDX-License-Identifier: BSD-3-Clause
#include "tools/terrane/new_archive.h"

#include "core/files.h"

#include <filesystem>
#include <ostream>
#include <string_view>

namespace fs = std::filesystem;

namespace {

// As a shell takes it for one word.
std::string asWord(const std::string& name) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                        "0123456789_-./+,:@%=";
    const bool plain = name.find_first_not_of(kPlain) == std::string::npos;
    if (plain) return name;
    std::string quoted = "'";
    for (const char c : name)
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

} // namespace

int makeNewArchive(const std::string& name, std::ostream& out, std::ostream& err) {
    std::error_code error;
    const fs::path example = terrane::homeFolder() / "archives" / "quadtree";
    if (!fs::is_directory(example, error)) {
        err << "terrane: can't find the example archives\n";
        return 1;
    }
    if (name.empty()) {
        err << "terrane: the new archive needs a name\n";
        return 2;
    }
    if (fs::exists(name, error)) {
        err << "terrane: '" << name << "' exists already\n";
        return 1;
    }
    fs::create_directories(name, error);
    if (error) {
        err << "terrane: can't make " << name << ": " << error.message() << "\n";
        return 1;
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(example, error)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".xml" && extension != ".glsl") continue; // no pictures, no tests
        if (entry.path().filename() == "schemas.xml") continue;    // of this repository
        fs::copy_file(entry.path(), fs::path(name) / entry.path().filename(), error);
        if (error) break;
    }
    if (error) {
        err << "terrane: can't write " << name << ": " << error.message() << "\n";
        return 1;
    }
    out << "Made " << name << ". Now try\n  terrane play " << asWord(name)
        << " --headless --screenshot picture.png\n";
    return 0;
}
