// SPDX-License-Identifier: BSD-3-Clause
#include "resource/build_context.h"

#include "core/random_access_file.h"
#include "core/text.h"
#include "resource/manager.h"

namespace terrane {

std::optional<std::filesystem::path>
BuildContext::findFile(const std::string& name, const Place& place,
                       FileStamp::Significant significant) const {
    ++uses_;
    auto path = manager_.library().findFile(name, place, diagnostics_);
    if (path)
        addFile(name, *path, significant);
    else
        addMissingFile(name);
    return path;
}

void BuildContext::addMissingFile(const std::string& name) const {
    ++uses_;
    entry_.files.push_back({name, {}, {}});
}

void BuildContext::addFile(const std::string& name, const std::filesystem::path& path,
                           FileStamp::Significant significant) const {
    ++uses_;
    entry_.files.push_back({name, path, manager_.library().stamp(path, significant)});
}

std::optional<std::string> BuildContext::readFile(const std::string& name,
                                                  const Place& place) const {
    const auto path = findFile(name, place);
    if (!path) return std::nullopt;
    std::string problem;
    auto bytes = files().read(*path, &problem);
    if (!bytes) reportUnreadable(name, place, problem);
    return bytes;
}

std::unique_ptr<RandomAccessFile> BuildContext::openFile(const std::string& name,
                                                         const Place& place) const {
    const auto path = findFile(name, place);
    if (!path) return nullptr;
    entry_.files.back().inPieces = true;
    std::string problem;
    auto file = files().open(*path, &problem);
    if (!file) reportUnreadable(name, place, problem);
    return file;
}

const FileTree& BuildContext::files() const {
    return manager_.library().searchPath().files();
}

void BuildContext::reportUnreadable(const std::string& name, const Place& place,
                                    const std::string& problem) const {
    diagnostics_.error("file-unreadable", place,
                       "can't read " + inQuotes(name) + (problem.empty() ? "" : ": " + problem));
}

std::shared_ptr<const SourceFile>
BuildContext::readSource(const std::string& name, const Place& place,
                         FileStamp::Significant significant) const {
    const auto path = findFile(name, place, significant);
    if (!path) return nullptr;
    std::string problem;
    auto source = manager_.library().source(*path, &problem);
    if (!source) reportUnreadable(name, place, problem);
    return source;
}

void BuildContext::loadReference(const RefBase& ref, std::type_index interface) const {
    ++uses_;
    if (!ref.entry()) manager_.resolve(ref, interface, &entry_);
}

} // namespace terrane
