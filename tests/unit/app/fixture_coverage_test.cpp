// SPDX-License-Identifier: BSD-3-Clause
#include "app/register_types.h"
#include "core/files.h"
#include "plugins/standard_plugins.h"
#include "resource/registry.h"

#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>

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

} // namespace

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
