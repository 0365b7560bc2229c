// SPDX-License-Identifier: BSD-3-Clause
#include "resource/prepared_data.h"

#include "core/text.h"

namespace terrane {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMakes = "# makes:";

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Each piece between two '*' is taken at its first place, which leaves the most for the rest.
bool matches(std::string_view pattern, std::string_view name) {
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) return pattern == name;
    if (!name.starts_with(pattern.substr(0, star))) return false;
    name.remove_prefix(star);
    pattern.remove_prefix(star + 1);
    for (std::size_t next; (next = pattern.find('*')) != std::string_view::npos;) {
        const std::size_t at = name.find(pattern.substr(0, next));
        if (at == std::string_view::npos) return false;
        name.remove_prefix(at + next);
        pattern.remove_prefix(next + 1);
    }
    return name.ends_with(pattern);
}

bool makes(std::string_view script, std::string_view name) {
    for (const std::string_view line : split(script, '\n')) {
        if (!line.starts_with(kMakes)) continue;
        if (matches(trimmed(line.substr(kMakes.size())), name)) return true;
    }
    return false;
}

} // namespace

std::optional<fs::path> preparingScript(const SearchPath& searchPath, const std::string& name) {
    for (const fs::path& folder : searchPath.folders()) {
        const auto script = searchPath.files().read(folder / "prepare");
        if (script && makes(*script, name)) return folder / "prepare";
    }
    return std::nullopt;
}

} // namespace terrane
