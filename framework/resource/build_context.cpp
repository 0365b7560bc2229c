// SPDX-License-Identifier: BSD-3-Clause
#include "resource/build_context.h"

#include "resource/manager.h"

namespace terrane {

std::optional<std::filesystem::path> BuildContext::findFile(const std::string& name,
                                                            const Place& place) const {
    auto path = manager_.library().findFile(name, place, diagnostics_);
    if (path) entry_.files.push_back(*path);
    return path;
}

std::shared_ptr<const SourceFile> BuildContext::readSource(const std::string& name,
                                                           const Place& place) const {
    const auto path = findFile(name, place);
    if (!path) return nullptr;
    auto source = manager_.library().source(*path);
    if (!source) diagnostics_.error("file-unreadable", place, "can't read '" + name + "'");
    return source;
}

void BuildContext::loadReference(const RefBase& ref, std::type_index interface) const {
    if (!ref.entry()) manager_.resolve(ref, interface, &entry_);
}

} // namespace terrane
