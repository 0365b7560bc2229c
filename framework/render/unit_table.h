// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace terrane {

/// What sits at a unit: an object, and how it is used if that matters.
struct UnitKey {
    UnitKey(std::uint64_t o, std::uint64_t v = 0) // implicit: most objects have but one use
        : object(o)
        , variant(v) {}
    std::uint64_t object;
    std::uint64_t variant;
    bool operator==(const UnitKey&) const = default;
};

/// Deals out a limited number of units (texture units, uniform buffer bindings) to any number of
/// objects: what was used least recently makes room. Objects that one draw needs together never
/// displace one another, as long as there are enough units for that draw.
class UnitTable {
public:
    explicit UnitTable(unsigned units);

    /// A new draw begins: what earlier draws used may be displaced.
    void beginDraw() { ++draw_; }
    /// The unit of an object for this draw. @param key the object; never 0
    /// @param hint the unit that it had before, tried first
    unsigned unitFor(const UnitKey& key, unsigned hint);

    unsigned size() const { return static_cast<unsigned>(units_.size()); }

private:
    struct Unit {
        UnitKey key = 0;
        std::uint64_t lastDraw = 0;
    };

    std::vector<Unit> units_;
    std::uint64_t draw_ = 0;
};

} // namespace terrane
