// SPDX-License-Identifier: BSD-3-Clause
#include "resource/build_context.h"

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
        entry_.files.push_back({name, {}, {}}); // it may come to be
    return path;
}

void BuildContext::addFile(const std::string& name, const std::filesystem::path& path,
                           FileStamp::Significant significant) const {
    ++uses_;
    entry_.files.push_back({name, path, FileStamp::of(path, significant)});
}

std::shared_ptr<const SourceFile>
BuildContext::readSource(const std::string& name, const Place& place,
                         FileStamp::Significant significant) const {
    const auto path = findFile(name, place, significant);
    if (!path) return nullptr;
    auto source = manager_.library().source(*path);
    if (!source) diagnostics_.error("file-unreadable", place, "can't read '" + name + "'");
    return source;
}

void BuildContext::loadReference(const RefBase& ref, std::type_index interface) const {
    ++uses_;
    if (!ref.entry()) manager_.resolve(ref, interface, &entry_);
}

} // namespace terrane
