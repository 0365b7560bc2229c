// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"
#include "core/text.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

namespace fs = std::filesystem;
using namespace terrane;

namespace {

using Names = std::set<std::string>;

fs::path sourceFolder() {
    const char* const folder = std::getenv("TERRANE_SOURCE");
    return folder ? folder : "";
}

void addMatches(const std::string& text, const std::regex& pattern, const std::string& prefix,
                Names& names) {
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
        names.insert(prefix + (*match)[1].str());
}

// What is written as a code is: where one is given, and every other word with a '-' between quotes.
Names codesInSources() {
    static const std::regex given(
        R"re((?:\.code = |\b(?:error|warning)\()\s*"([a-z](?:[a-z0-9-]*[a-z0-9])?)")re");
    static const std::regex word(R"re("([a-z]+(?:-[a-z0-9]+)+)")re");
    static const std::regex missing(R"re(reportMissing\([^;"]*"([a-z]+)")re");
    Names codes;
    for (const char* folder : {"framework", "plugins", "tools/terrane"}) {
        for (const auto& file : fs::recursive_directory_iterator(sourceFolder() / folder)) {
            const fs::path extension = file.path().extension();
            if (extension != ".cpp" && extension != ".h") continue;
            const std::string text = readFile(file.path()).value_or("");
            addMatches(text, given, "", codes);
            addMatches(text, word, "", codes);
            addMatches(text, missing, "missing-", codes);
        }
    }
    // A command of scripts, a file, a folder.
    for (const char* other : {"no-errors", "terrane-resources", "terrane-fixtures"})
        codes.erase(other);
    return codes;
}

Names without(const Names& all, const Names& some) {
    Names rest;
    std::set_difference(all.begin(), all.end(), some.begin(), some.end(),
                        std::inserter(rest, rest.end()));
    return rest;
}

std::string listed(const Names& names) {
    std::string text;
    for (const std::string& name : names)
        text += name + " ";
    return text;
}

} // namespace

TEST_CASE("docs/diagnostics.md lists the codes of all diagnostics, and no others") {
    if (sourceFolder().empty()) {
        MESSAGE("skipped: TERRANE_SOURCE is not set");
        return;
    }
    const auto page = readFile(sourceFolder() / "docs" / "diagnostics.md");
    REQUIRE(page);
    const std::string text = page->substr(page->find("## Codes"));
    static const std::regex row(
        R"re(\n\| `([a-z0-9-]+)` \| (?:error|warning|note|error, warning) \| \S)re");
    Names listing;
    addMatches(text, row, "", listing);
    const Names codes = codesInSources();
    CHECK(codes.size() > 70);
    CHECK(listed(without(codes, listing)) == "");
    CHECK(listed(without(listing, codes)) == "");
    // Each row has been taken for one.
    const auto rows = std::count(text.begin(), text.end(), '\n');
    CHECK(static_cast<std::size_t>(rows) > listing.size());
}
