// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as an archive: parsed, validated, loaded, and everything told about them printed. What
// stands behind a line "=== reload" is the archive as it was edited: it is reloaded and rolled
// back, and then, if it is good, reloaded for good.
#include "require.h"
#include "resource/manager.h"
#include "resource/reload.h"
#include "resource/test_types.h"
#include "resource/xml_fault.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

using namespace terrane;
using test::require;

namespace {

constexpr std::string_view kReload = "\n=== reload\n";

/// The types of the test, declared once.
struct Types {
    Types() { test::declareTestTypes(registry); }
    Registry registry;
};

const Registry& registry() {
    static const Types types;
    return types.registry;
}

/// All that a reload may touch of an entry.
struct Snapshot {
    std::string name;
    ResourceEntry* entry = nullptr;
    ResourceEntry::State state{};
    const void* description = nullptr;
    const void* instance = nullptr;
    std::vector<ResourceEntry*> dependencies, dependents, madeFrom;

    bool operator==(const Snapshot&) const = default;
};

std::vector<Snapshot> snapshots(const ResourceManager& manager) {
    std::vector<Snapshot> list;
    for (const auto& [name, entry] : manager.entries()) {
        list.push_back({name, entry.get(), entry->state, entry->description.get(),
                        entry->instance.get(), entry->dependencies, entry->dependents,
                        entry->madeFrom});
        // Nobody cares for the order of those that name it.
        std::sort(list.back().dependents.begin(), list.back().dependents.end());
    }
    return list;
}

bool contains(const std::vector<ResourceEntry*>& list, const ResourceEntry* entry) {
    return std::find(list.begin(), list.end(), entry) != list.end();
}

/// Whether the entries point to one another, and only so, and nothing is in the making.
void checkGraph(const ResourceManager& manager) {
    std::vector<ResourceEntry*> entries;
    for (const auto& [name, entry] : manager.entries())
        entries.push_back(entry.get());
    for (const ResourceEntry* const entry : entries) {
        require(entry->state != ResourceEntry::State::loading, "nothing is half loaded");
        require((entry->state == ResourceEntry::State::ready) == (entry->instance != nullptr),
                "what is ready is there");
        for (const ResourceEntry* const dependency : entry->dependencies) {
            require(contains(entries, dependency), "what is needed is in the table");
            require(contains(dependency->dependents, entry), "what is needed knows it");
        }
        for (const ResourceEntry* const dependent : entry->dependents) {
            require(contains(entries, dependent), "who needs it is in the table");
            require(contains(dependent->dependencies, entry), "who needs it knows it");
        }
        for (const ResourceEntry* const source : entry->madeFrom)
            require(contains(entry->dependencies, source), "what it is made from is needed");
    }
}

/// An archive that is loaded, and its edits. Whatever is made must be dropped some time.
class World {
public:
    explicit World(std::string_view text)
        : library_(SearchPath(), diagnostics_)
        , manager_(registry(), library_, diagnostics_) {
        manager_.services().provide(log_);
        const auto source = std::make_shared<SourceFile>("a.xml", std::string(text));
        const bool added = library_.addArchive("a.xml", source);
        require(added == (diagnostics_.errors() == 0), "an archive or an error");
        manager_.loadAll();
        manager_.get<test::Fruit>("a");
        test::requireToldWell(diagnostics_);
        checkGraph(manager_);
        // Only a text that is no XML has a fault, and that lies within the text.
        const auto fault = findXmlFault(source->text());
        require(!fault || fault->offset <= text.size(), "a fault lies within the text");
    }

    /// To be called once: the manager refers to the edited library from then on.
    void edit(std::string_view text, Library& fresh) {
        diagnostics_.clear();
        const auto source = std::make_shared<SourceFile>("a.xml", std::string(text));
        if (!fresh.addArchive("a.xml", source)) return;
        const auto before = snapshots(manager_);
        const auto alive = count();
        std::vector<ResourceEntry*> roots;
        for (const Snapshot& snapshot : before)
            roots.push_back(snapshot.entry);
        {
            Reload reload(manager_, fresh);
            rebuild(reload);
            reload.rollBack();
        }
        test::requireToldWell(diagnostics_);
        require(snapshots(manager_) == before, "all is as before what was rolled back");
        require(count() == alive, "nothing stays of what was rolled back");
        checkGraph(manager_);

        Reload reload(manager_, fresh);
        rebuild(reload);
        if (diagnostics_.errors() > 0 || roots.empty()) return; // rolled back, too
        reload.commit({roots.front()});
        checkGraph(manager_);
    }

private:
    void rebuild(Reload& reload) {
        reload.rebuild();
        manager_.get<test::Fruit>("a");
        checkGraph(manager_);
    }
    /// Instances that are alive.
    std::ptrdiff_t count() const {
        std::ptrdiff_t alive = 0;
        for (const std::string& line : log_.lines)
            alive += line.starts_with("make ") ? 1 : -1;
        return alive;
    }

    test::Log log_;
    Diagnostics diagnostics_;
    Library library_;
    ResourceManager manager_;
};

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const std::size_t mark = text.find(kReload);
    Diagnostics editing;
    Library fresh(SearchPath(), editing); // outlives the manager
    World world(text.substr(0, mark));
    if (mark != std::string_view::npos) world.edit(text.substr(mark + kReload.size()), fresh);
    return 0;
}
