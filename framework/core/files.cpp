// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <dlfcn.h>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace terrane {

namespace fs = std::filesystem;

namespace {

bool equalIgnoringCase(std::string_view a, std::string_view b) {
    const auto equal = [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) ==
               std::tolower(static_cast<unsigned char>(y));
    };
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), equal);
}

bool isFile(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

std::string withSlashes(std::string_view name) {
    std::string result(name);
    std::replace(result.begin(), result.end(), '\\', '/');
    return result;
}

bool isHome(const fs::path& folder) {
    std::error_code error;
    return fs::exists(folder / "resources" / "terrane-resources", error);
}

// The library that this code is in, or the program when it is linked in statically.
fs::path moduleFile() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<void*>(&isHome), &info) != 0 && info.dli_fname)
        return fs::absolute(info.dli_fname);
    return {};
}

fs::path homeAbove(fs::path file) {
    std::error_code error;
    file = fs::canonical(file, error);
    if (error) return {};
    for (fs::path folder = file.parent_path();; folder = folder.parent_path()) {
        if (isHome(folder)) return folder;
        if (isHome(folder / "share" / "terrane")) return folder / "share" / "terrane";
        if (folder == folder.root_path()) return {};
    }
}

} // namespace

std::optional<std::string> readFile(const fs::path& path) {
    if (!isFile(path)) return std::nullopt;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) return std::nullopt;
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    if (stream.bad()) return std::nullopt;
    return std::move(bytes).str();
}

void makeFolderOf(const fs::path& file) {
    std::error_code ignored; // whoever writes the file will notice
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
}

bool writeFile(const fs::path& path, std::string_view bytes) {
    fs::path beside = path;
    beside += "." + std::to_string(::getpid()) + ".tmp";
    {
        std::ofstream stream(beside, std::ios::binary);
        stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        stream.flush();
        if (!stream) {
            std::error_code ignored;
            fs::remove(beside, ignored);
            return false;
        }
    }
    std::error_code error;
    fs::rename(beside, path, error);
    if (!error) return true;
    fs::remove(beside, error);
    return false;
}

std::string shownPath(const fs::path& path) {
    std::error_code error;
    const fs::path relative = fs::proximate(path, error);
    if (error || relative.empty()) return path.string();
    const std::string shorter = relative.string();
    return shorter.size() <= path.string().size() ? shorter : path.string();
}

fs::path homeFolder() {
    if (const char* home = std::getenv("TERRANE_HOME")) return home;
    for (const fs::path& file : {moduleFile(), fs::path("/proc/self/exe")}) {
        fs::path home = homeAbove(file);
        if (!home.empty()) return home;
    }
    return {};
}

void SearchPath::add(fs::path folder) {
    if (std::find(folders_.begin(), folders_.end(), folder) == folders_.end())
        folders_.push_back(std::move(folder));
}

bool SearchPath::leavesFolders(std::string_view name) {
    const fs::path path = withSlashes(name);
    const bool drive = name.size() > 1 && name[1] == ':';
    return path.is_absolute() || drive || std::find(path.begin(), path.end(), "..") != path.end();
}

// Walks down the name's parts, taking an entry of equal name where there is one, else the first (in
// the order of their names) whose case differs.
std::optional<fs::path> SearchPath::findIgnoringCase(fs::path folder, const fs::path& name) const {
    for (const fs::path& part : name) {
        if (files_.isFile(folder / part) || files_.isFolder(folder / part)) {
            folder /= part;
            continue;
        }
        const std::vector<std::string> names = files_.namesIn(folder);
        const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& other) {
            return equalIgnoringCase(other, part.string());
        });
        if (found == names.end()) return std::nullopt;
        folder /= *found;
    }
    return files_.isFile(folder) ? std::optional(folder) : std::nullopt;
}

std::optional<SearchPath::Found> SearchPath::find(std::string_view name) const {
    const std::vector<Found> all = findAll(name);
    return all.empty() ? std::nullopt : std::optional(all.front());
}

std::vector<SearchPath::Found> SearchPath::findAll(std::string_view name) const {
    std::vector<Found> all;
    if (name.empty() || leavesFolders(name) || name.find('\0') != std::string_view::npos)
        return all;
    const fs::path relative = withSlashes(name);
    for (const fs::path& folder : folders_) {
        if (files_.isFile(folder / relative)) all.push_back({folder / relative, false});
    }
    if (!all.empty()) return all;
    for (const fs::path& folder : folders_) {
        if (auto path = findIgnoringCase(folder, relative)) all.push_back({*path, true});
    }
    return all;
}

std::vector<std::string> SearchPath::namesNear(std::string_view name) const {
    std::vector<std::string> names;
    if (leavesFolders(name)) return names;
    const fs::path within = fs::path(withSlashes(name)).parent_path();
    for (const fs::path& folder : folders_) {
        for (const std::string& entry : files_.namesIn(folder / within))
            names.push_back((within / entry).string());
    }
    return names;
}

} // namespace terrane
