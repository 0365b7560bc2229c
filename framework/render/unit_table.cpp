// SPDX-License-Identifier: BSD-3-Clause
#include "render/unit_table.h"

#include <algorithm>
#include <cassert>

namespace terrane {

UnitTable::UnitTable(unsigned units)
    : units_(units) {
    assert(units > 0 && "UnitTable: no units");
}

unsigned UnitTable::unitFor(const UnitKey& key, unsigned hint) {
    std::size_t index = hint < units_.size() ? hint : 0;
    if (units_[index].key != key) {
        const auto held = std::find_if(units_.begin(), units_.end(),
                                       [&](const Unit& unit) { return unit.key == key; });
        const auto oldest =
            std::min_element(units_.begin(), units_.end(),
                             [](const Unit& a, const Unit& b) { return a.lastDraw < b.lastDraw; });
        index = static_cast<std::size_t>((held != units_.end() ? held : oldest) - units_.begin());
    }
    units_[index] = {key, draw_};
    return static_cast<unsigned>(index);
}

} // namespace terrane
