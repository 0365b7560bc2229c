// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/files.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace terrane {

/// Texts of a file, and what is to stand there instead; the first place of each is meant.
using TextEdits = std::vector<std::pair<std::string, std::string>>;

/// The folder of one of our example archives.
inline std::filesystem::path exampleArchive(const std::string& name) {
    const char* const source = std::getenv("TERRANE_SOURCE");
    return std::filesystem::path(source ? source : ".") / "archives" / name;
}

/// A file, changed. A text that is not there fails the test.
inline std::string edited(const std::filesystem::path& file, const TextEdits& edits) {
    auto text = readFile(file);
    REQUIRE(text);
    for (const auto& [before, after] : edits) {
        CAPTURE(before);
        const std::size_t at = text->find(before);
        REQUIRE(at != std::string::npos);
        text->replace(at, before.size(), after);
    }
    return *text;
}

} // namespace terrane
