// SPDX-License-Identifier: BSD-3-Clause
#include "core/file_tree.h"

#include "core/files.h"
#include "core/random_access_file.h"
#include "core/zip_file.h"

#include <algorithm>

namespace terrane {

namespace fs = std::filesystem;

std::optional<std::string> FileTree::nameInZip(const fs::path& path) const {
    if (!zip_) return std::nullopt;
    const std::string& top = zip_->path().native();
    const std::string& text = path.native();
    if (!text.starts_with(top)) return std::nullopt;
    if (text.size() == top.size()) return "";
    if (text[top.size()] != '/') return std::nullopt;
    std::string name = fs::path(text.substr(top.size() + 1)).lexically_normal().string();
    if (name.ends_with('/')) name.pop_back();
    return name == "." ? "" : name;
}

bool FileTree::isFile(const fs::path& path) const {
    if (const auto name = nameInZip(path)) return zip_->find(*name) != nullptr;
    std::error_code error;
    return fs::is_regular_file(path, error);
}

bool FileTree::isFolder(const fs::path& path) const {
    if (const auto name = nameInZip(path)) return zip_->isFolder(*name);
    std::error_code error;
    return fs::is_directory(path, error);
}

std::vector<std::string> FileTree::namesIn(const fs::path& folder) const {
    if (const auto name = nameInZip(folder)) return zip_->namesIn(*name);
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        names.push_back(entry->path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::optional<std::string> FileTree::read(const fs::path& path, std::string* problem) const {
    const auto name = nameInZip(path);
    if (!name) return readFile(path);
    const ZipFile::Entry* const entry = zip_->find(*name);
    std::string ignored;
    return entry ? zip_->read(*entry, problem ? *problem : ignored) : std::nullopt;
}

std::unique_ptr<RandomAccessFile> FileTree::open(const fs::path& path, std::string* problem) const {
    const auto name = nameInZip(path);
    if (!name) return RandomAccessFile::open(path);
    const ZipFile::Entry* const entry = zip_->find(*name);
    std::string ignored;
    return entry ? zip_->openEntry(*entry, problem ? *problem : ignored) : nullptr;
}

} // namespace terrane
