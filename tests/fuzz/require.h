// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"

#include <cstdio>
#include <cstdlib>

namespace terrane::test {

/// What must hold for any bytes; a fuzzer takes the abort for a find.
inline void require(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
}

/// Everything that is told can be printed, and points into a text.
inline void requireToldWell(const Diagnostics& diagnostics) {
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        const Place& place = diagnostic.place;
        require(!place || place.offset <= place.file->text().size(),
                "a diagnostic points into its text");
        require(!toString(diagnostic).empty(), "a diagnostic says something");
    }
}

} // namespace terrane::test
