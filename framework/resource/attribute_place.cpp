// SPDX-License-Identifier: BSD-3-Clause
#include "resource/attribute_place.h"

#include <string_view>

namespace terrane {

Place attributeName(const Place& value) {
    if (!value.file) return value;
    constexpr std::string_view blanks = " \t\r\n";
    const std::string_view before = std::string_view(value.file->text()).substr(0, value.offset);
    if (before.empty() || (before.back() != '"' && before.back() != '\'')) return value;
    const std::size_t equals = before.find_last_not_of(blanks, before.size() - 2);
    if (equals == std::string_view::npos || equals == 0 || before[equals] != '=') return value;
    const std::size_t last = before.find_last_not_of(blanks, equals - 1);
    if (last == std::string_view::npos) return value;
    const std::size_t blank = before.find_last_of(blanks, last);
    return {value.file, blank == std::string_view::npos ? 0 : blank + 1};
}

} // namespace terrane
