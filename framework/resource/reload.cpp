// SPDX-License-Identifier: BSD-3-Clause
#include "resource/reload.h"

#include <algorithm>
#include <utility>

namespace terrane {

namespace {

void remove(std::vector<ResourceEntry*>& list, const ResourceEntry* entry) {
    std::erase(list, entry);
}

/// Takes an entry out of the lists of those that it depends on.
void disconnect(ResourceEntry& entry) {
    for (ResourceEntry* const dependency : entry.dependencies)
        remove(dependency->dependents, &entry);
}

void reconnect(ResourceEntry& entry) {
    for (ResourceEntry* const dependency : entry.dependencies)
        dependency->dependents.push_back(&entry);
}

ResourceVersion take(ResourceEntry& entry) {
    return std::exchange(static_cast<ResourceVersion&>(entry), {});
}

// What was made last goes first: it may use what was made before.
void destroy(std::vector<ResourceVersion> versions) {
    std::sort(versions.begin(), versions.end(),
              [](const auto& a, const auto& b) { return a.order > b.order; });
    for (ResourceVersion& version : versions)
        version = {};
}

} // namespace

Reload::Reload(ResourceManager& manager, Library& fresh)
    : manager_(manager)
    , fresh_(fresh)
    , stale_(manager.library()) {
    manager_.suggestionsLeft_ = ResourceManager::kMostSuggestions;
    findAffected();
}

Reload::~Reload() {
    if (open_) rollBack();
}

bool Reload::isChanged(const UsedFile& file) {
    const auto [known, isNew] = found_.try_emplace(file.name);
    if (isNew) {
        if (const auto found = fresh_.searchPath().find(file.name)) known->second = found->path;
    }
    if (file.path.empty()) return known->second.has_value();
    // The name may lead to another file than before.
    return known->second != file.path || file.stamp.differs(file.path, fresh_.searchPath().files());
}

bool Reload::isChanged(ResourceEntry& entry) {
    const auto found = fresh_.find(entry.name);
    if (!found) {
        gone_.insert(&entry);
        return true;
    }
    if (entry.state == ResourceEntry::State::failed || entry.incomplete) return true;
    if (found->element.fingerprint() != entry.fingerprint) return true;
    return std::any_of(entry.files.begin(), entry.files.end(),
                       [this](const UsedFile& file) { return isChanged(file); });
}

void Reload::findAffected() {
    std::vector<ResourceEntry*> queue;
    const auto add = [&](ResourceEntry* entry) {
        if (affected_.insert(entry).second) queue.push_back(entry);
    };
    for (const auto& [name, entry] : manager_.entries_) {
        if (isChanged(*entry)) add(entry.get());
    }
    for (std::size_t next = 0; next < queue.size(); ++next) {
        ResourceEntry* const entry = queue[next];
        for (ResourceEntry* const dependent : entry->dependents) {
            const auto& from = dependent->madeFrom;
            if (dependent->state == ResourceEntry::State::unloaded) continue; // no resource
            const bool madeFrom = std::find(from.begin(), from.end(), entry) != from.end();
            // Who names what is gone has to tell so.
            if (madeFrom || gone_.contains(entry)) add(dependent);
        }
    }
}

void Reload::setAside(ResourceEntry& entry) {
    disconnect(entry);
    transaction_.replaced.emplace(&entry, take(entry));
}

void Reload::rebuild() {
    std::vector<ResourceEntry*> order(affected_.begin(), affected_.end());
    std::sort(order.begin(), order.end(),
              [](const auto* a, const auto* b) { return a->order < b->order; });
    for (ResourceEntry* const entry : order)
        setAside(*entry);
    manager_.library_ = &fresh_;
    manager_.transaction_ = &transaction_;
    for (ResourceEntry* const entry : order) {
        if (entry->dependents.empty()) continue;
        // What follows from its name alone is blamed on where it was named.
        const ResourceVersion& before = transaction_.replaced.at(entry);
        const bool named = before.descriptor.empty() && before.description;
        manager_.load(entry->name, named ? before.description->place : Place());
    }
}

std::set<ResourceEntry*> Reload::needed(const std::vector<ResourceEntry*>& roots) const {
    std::set<ResourceEntry*> result;
    std::vector<ResourceEntry*> queue = roots;
    while (!queue.empty()) {
        ResourceEntry* const entry = queue.back();
        queue.pop_back();
        if (!entry || !result.insert(entry).second) continue;
        queue.insert(queue.end(), entry->dependencies.begin(), entry->dependencies.end());
    }
    return result;
}

void Reload::commit(const std::vector<ResourceEntry*>& roots) {
    open_ = false;
    manager_.library_ = &fresh_;
    manager_.transaction_ = nullptr;
    std::vector<ResourceVersion> old;
    for (auto& [entry, version] : transaction_.replaced)
        old.push_back(std::move(version));
    const std::set<ResourceEntry*> kept = needed(roots);
    auto& entries = manager_.entries_;
    std::vector<std::unique_ptr<ResourceEntry>> dropped;
    for (auto at = entries.begin(); at != entries.end();) {
        if (kept.contains(at->second.get())) {
            ++at;
            continue;
        }
        disconnect(*at->second);
        old.push_back(take(*at->second));
        dropped.push_back(std::move(at->second)); // others that go may still point to it
        at = entries.erase(at);
    }
    destroy(std::move(old));
    transaction_ = {};
}

void Reload::rollBack() {
    open_ = false;
    manager_.library_ = &stale_;
    manager_.transaction_ = nullptr;
    std::vector<ResourceVersion> fresh;
    const auto drop = [&](ResourceEntry& entry) {
        disconnect(entry);
        fresh.push_back(take(entry));
    };
    for (const auto& [entry, version] : transaction_.replaced)
        drop(*entry);
    for (ResourceEntry* const entry : transaction_.added)
        drop(*entry);
    for (auto& [entry, version] : transaction_.replaced) {
        static_cast<ResourceVersion&>(*entry) = std::move(version);
        reconnect(*entry);
    }
    destroy(std::move(fresh));
    for (ResourceEntry* const entry : transaction_.added) {
        // A copy: the name goes with the entry.
        manager_.entries_.erase(std::string(entry->name));
    }
    transaction_ = {};
}

} // namespace terrane
