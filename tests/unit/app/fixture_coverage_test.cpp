// SPDX-License-Identifier: BSD-3-Clause
#include "app/register_types.h"
#include "core/files.h"
#include "plugins/standard_plugins.h"
#include "resource/registry.h"
#include "resource/xml.h"

#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

using namespace terrane;
namespace fs = std::filesystem;

namespace {

// Whether a fixture below a folder has a line in its script.
bool hasFixture(const fs::path& folder, const std::string& line) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error)) {
        if (entry.path().filename() != "script") continue;
        const auto script = readFile(entry.path());
        if (script && ("\n" + *script).find("\n" + line) != std::string::npos) return true;
    }
    return false;
}

// What the fixtures of a folder write of an element, and where their scripts expect it to be wrong.
struct Uses {
    std::set<std::string> good, wrong;
};

using UsesByElement = std::map<const ElementDeclaration*, Uses>;

class FixtureReader {
public:
    FixtureReader(const Registry& registry, UsesByElement& uses)
        : registry_(registry)
        , uses_(uses) {}

    void read(const fs::path& folder) {
        const auto script = readFile(folder / "script");
        const auto archive = readFile(folder / "archive.xml");
        if (!script || !archive) return;
        wrongPlaces_.clear();
        const std::regex expectation("expect diagnostic \\S+ archive\\.xml:(\\d+):(\\d+)");
        for (std::sregex_iterator i(script->begin(), script->end(), expectation), end; i != end;
             ++i)
            wrongPlaces_.push_back({std::stoi((*i)[1]), std::stoi((*i)[2])});
        works_ = script->find("expect no-errors") != std::string::npos ||
                 script->find("expect image") != std::string::npos;
        Diagnostics diagnostics;
        const auto document =
            XmlDocument::parse(std::make_shared<SourceFile>("archive.xml", *archive), diagnostics);
        if (!document) return;
        for (const XmlElement& entry : document->root().children())
            read(entry, registry_.findTopLevel(entry.tag()));
    }

private:
    void read(const XmlElement& element, const ElementDeclaration* declaration) {
        if (!declaration) declaration = registry_.find(element.tag());
        if (!declaration) return;
        Uses& uses = uses_[declaration];
        for (const XmlAttribute& xml : element.attributes()) {
            const AttributeDeclaration* const a = declaration->attribute(xml.name);
            if (!a) continue;
            if (works_) uses.good.insert(a->name);
            const std::size_t first = xml.namePlace.offset;
            if (isWrong(xml.namePlace, first, xml.valuePlace.offset + xml.value.size()))
                uses.wrong.insert(a->name);
        }
        for (const XmlElement& child : element.children())
            read(child, childDeclaration(*declaration, child.tag()));
    }

    static const ElementDeclaration* childDeclaration(const ElementDeclaration& parent,
                                                      const std::string& tag) {
        // Exact names go before prefixes.
        const ElementDeclaration* found = nullptr;
        for (const ChildRule& rule : parent.childRules) {
            if (!rule.element || !rule.element->matches(tag)) continue;
            if (!found || rule.element->tag.size() > found->tag.size()) found = rule.element;
        }
        return found;
    }

    bool isWrong(const Place& place, std::size_t first, std::size_t last) const {
        for (std::size_t offset = first; offset <= last; ++offset) {
            const LineColumn at = Place{place.file, offset}.position();
            for (const LineColumn& wrong : wrongPlaces_) {
                if (wrong.line == at.line && wrong.column == at.column) return true;
            }
        }
        return false;
    }

    const Registry& registry_;
    UsesByElement& uses_;
    std::vector<LineColumn> wrongPlaces_;
    bool works_ = false;
};

// Elements of the framework that are no part of the kernel.
bool isOfTerrain(const std::string& tag) {
    const std::set<std::string> tags{"gpuTileStorage", "tileSampler", "tileSamplerZ",
                                     "terrainNode"};
    return tags.contains(tag);
}

void checkUses(const ElementDeclaration& element, const UsesByElement& uses,
               std::set<const ElementDeclaration*>& seen) {
    if (element.planned || isOfTerrain(element.tag) || !seen.insert(&element).second) return;
    if (element.prefix && element.knownTags.empty()) return; // only tells which tags are none
    const auto found = uses.find(&element);
    CAPTURE(element.tag);
    REQUIRE(found != uses.end());
    for (const AttributeDeclaration& a : element.attributes) {
        if (a.planned || !a.read) continue; // has no effect
        CAPTURE(a.name);
        CHECK(found->second.good.contains(a.name));
        CHECK(found->second.wrong.contains(a.name));
    }
    for (const ChildRule& rule : element.childRules) {
        if (rule.element) checkUses(*rule.element, uses, seen);
    }
}

} // namespace

TEST_CASE(
    "each attribute of the kernel has a fixture in which it works, and one in which it is wrong") {
    const char* const source = std::getenv("TERRANE_SOURCE");
    if (!source) return;
    Registry registry;
    registerStandardTypes(registry);
    UsesByElement uses;
    FixtureReader reader(registry, uses);
    std::error_code error;
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(source) / "tests" / "fixtures", error)) {
        if (entry.is_directory()) reader.read(entry.path());
    }
    std::set<const ElementDeclaration*> seen;
    for (const std::string& tag : registry.entryTags()) {
        if (const ElementDeclaration* declaration = registry.find(tag))
            checkUses(*declaration, uses, seen);
    }
}

TEST_CASE("each element has a fixture that works, and one that is wrong") {
    const char* const source = std::getenv("TERRANE_SOURCE");
    if (!source) return;
    Registry registry;
    registerStandardTypes(registry);
    registerStandardPlugins(registry);
    for (const std::string& tag : registry.entryTags()) {
        const ElementDeclaration* declaration = registry.find(tag);
        if (declaration && declaration->planned) continue;
        CAPTURE(tag);
        const fs::path folder = fs::path(source) / "tests" / "fixtures" / tag;
        CHECK(hasFixture(folder, "expect no-errors"));
        CHECK(hasFixture(folder, "expect diagnostic "));
    }
}
