// SPDX-License-Identifier: BSD-3-Clause
#include "resource/manager.h"

#include "core/text.h"

// What the manager has to tell of names.
namespace terrane {

std::string ResourceManager::described(const ResourceEntry& entry) {
    const std::string tag = entry.declaration ? entry.declaration->tag : "resource";
    return tag + " " + inQuotes(entry.name);
}

void ResourceManager::warnName(const std::string& name, const FoundElement& found,
                               const Place& place) {
    if (found.caseDiffers) {
        diagnostics_.warning("case-differs", place ? place : found.element.place(),
                             inQuotes(name + ".xml") + " is found only as " +
                                 inQuotes(found.file.filename().string()),
                             "the same case, which other systems need");
    }
    const std::size_t end = name.rfind(';');
    if (found.synthesised && end != std::string::npos && end + 1 < name.size()) {
        diagnostics_.warning("program-tail", place,
                             inQuotes(name.substr(end + 1)) +
                                 " has no ';' behind it and is ignored",
                             inQuotes(name + ";"));
    }
}

void ResourceManager::reportUnknown(const std::string& name, const Place& place) {
    if (SearchPath::leavesFolders(name)) {
        diagnostics_.report({.code = "name-leaves-folders",
                             .place = place,
                             .message = inQuotes(name) + " leaves the search folders",
                             .expected = "a name without '..' that does not start with '/'",
                             .chain = chain()});
        return;
    }
    const bool buffer = name.starts_with("renderbuffer");
    diagnostics_.report(
        {.code = "unknown-resource",
         .place = place,
         .message = "there is no resource " + inQuotes(name),
         .expected = buffer ? "renderbuffer-<size>-<internal format>"
                            : "an entry of the archive, or a file " + inQuotes(name + ".xml"),
         .suggestion = suggestName(name),
         .chain = chain()});
}

void ResourceManager::reportCycle(const ResourceEntry& entry, const Place& place) {
    std::string circle;
    bool inside = false;
    for (const Loading& loading : loading_) {
        inside |= loading.entry == &entry;
        if (inside) circle += loading.entry->name + " > ";
    }
    diagnostics_.report({.code = "cycle",
                         .place = place,
                         .message = described(entry) + " needs itself: " + circle + entry.name,
                         .chain = chain()});
}

void ResourceManager::reportMistyped(const RefBase& ref, const ResourceEntry& entry,
                                     std::type_index interface) {
    diagnostics_.report(
        {.code = "mistyped-reference",
         .place = ref.place,
         .message = inQuotes(ref.name) + " is " + withArticle(entry.declaration->tag),
         .expected = registry_.describeInterface(interface),
         .suggestion = suggestEntry(ref.name, interface),
         .chain = chain()});
}

// An entry, or else a file.
std::string ResourceManager::suggestName(const std::string& name) {
    if (suggestionsLeft_-- <= 0) return {};
    std::string nearest = nearestName(name, library_->names());
    if (!nearest.empty()) return nearest;
    std::vector<std::string> files;
    for (const std::string& file : library_->searchPath().namesNear(name)) {
        if (file.ends_with(".xml")) files.push_back(file.substr(0, file.size() - 4));
    }
    return nearestName(name, files);
}

// An entry that has the interface.
std::string ResourceManager::suggestEntry(const std::string& name, std::type_index interface) {
    if (suggestionsLeft_-- <= 0) return {};
    std::vector<std::string> names;
    for (const XmlElement& element : library_->entries()) {
        const ElementDeclaration* const declaration = registry_.find(element.tag());
        if (declaration && declaration->isA(interface)) names.push_back(element.attribute("name"));
    }
    return nearestName(name, names);
}

std::vector<std::string> ResourceManager::chain() const {
    std::vector<std::string> links;
    for (auto loading = loading_.rbegin(); loading != loading_.rend(); ++loading) {
        std::string link = described(*loading->entry);
        if (loading->neededAt) link += ", named at " + loading->neededAt.toString();
        links.push_back(std::move(link));
    }
    return links;
}

void ResourceManager::forward(const Diagnostics& local) {
    for (Diagnostic& diagnostic : local.all()) {
        if (diagnostic.chain.empty()) diagnostic.chain = chain();
        diagnostics_.report(std::move(diagnostic));
    }
}

} // namespace terrane
