// SPDX-License-Identifier: BSD-3-Clause
#include "resource/unused_resources.h"

#include "core/text.h"
#include "resource/manager.h"

#include <unordered_set>

namespace terrane {

namespace {

using Entries = std::unordered_set<const ResourceEntry*>;

Entries neededBy(std::vector<ResourceEntry*> queue) {
    Entries needed;
    while (!queue.empty()) {
        const ResourceEntry* const entry = queue.back();
        queue.pop_back();
        if (!entry || !needed.insert(entry).second) continue;
        queue.insert(queue.end(), entry->dependencies.begin(), entry->dependencies.end());
    }
    return needed;
}

} // namespace

void reportUnusedResources(ResourceManager& manager, const std::vector<ResourceEntry*>& roots) {
    const Entries needed = neededBy(roots);
    for (const XmlElement& element : manager.library().entries()) {
        const std::string name = element.attribute("name");
        const auto known = manager.entries().find(name);
        if (known == manager.entries().end()) continue;
        const ResourceEntry& entry = *known->second;
        if (!entry.declaration || entry.declaration->planned) continue;
        // Another entry of the same name has been told apart.
        if (!entry.description || !(entry.description->place == element.place())) continue;
        const bool used = needed.empty() ? !entry.dependents.empty() : needed.contains(&entry);
        if (used) continue;
        manager.diagnostics().warning("unused-resource", element.place(),
                                      "nothing that is played uses " + asTag(element.tag()) + " " +
                                          inQuotes(name));
    }
}

} // namespace terrane
