// SPDX-License-Identifier: BSD-3-Clause
#include "core/input_event.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace terrane {

std::optional<Key> keyNamed(std::string_view name) {
    // In the order of Key.
    static constexpr std::string_view kNames[] = {
        "escape",   "enter", "tab",  "backspace", "insert", "delete", "home", "end", "pageup",
        "pagedown", "up",    "down", "left",      "right",  "f1",     "f2",   "f3",  "f4",
        "f5",       "f6",    "f7",   "f8",        "f9",     "f10",    "f11",  "f12"};
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto* const found = std::find(std::begin(kNames), std::end(kNames), lower);
    if (found == std::end(kNames)) return std::nullopt;
    return static_cast<Key>(found - std::begin(kNames));
}

} // namespace terrane
