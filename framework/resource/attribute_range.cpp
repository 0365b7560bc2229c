// SPDX-License-Identifier: BSD-3-Clause
#include "resource/attribute_range.h"

#include "resource/declaration.h"

#include <cmath>
#include <fmt/format.h>

namespace terrane {

namespace {

// Without the zeros of limits that no author gets near.
std::string shown(double value) {
    return std::abs(value) < 1e9 ? fmt::format("{}", value) : fmt::format("{:g}", value);
}

} // namespace

std::string rangeOf(const AttributeDeclaration& a) {
    const std::string unit = a.unit.empty() ? "" : " " + a.unit;
    const bool below = std::isfinite(a.minimum);
    const bool above = std::isfinite(a.maximum);
    if (below && above && a.minimumExcluded)
        return fmt::format("more than {} and at most {}{}", shown(a.minimum), shown(a.maximum),
                           unit);
    if (below && above) return fmt::format("{} to {}{}", shown(a.minimum), shown(a.maximum), unit);
    if (!below && !above) return "a finite number";
    if (below)
        return fmt::format("{} {}{}", a.minimumExcluded ? "more than" : "at least",
                           shown(a.minimum), unit);
    return fmt::format("at most {}{}", shown(a.maximum), unit);
}

} // namespace terrane
