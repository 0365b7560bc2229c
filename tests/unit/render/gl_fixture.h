// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "render/context.h"

#include <doctest/doctest.h>

#include <memory>

namespace terrane {

/// A current off-screen context with debug output. A test that uses it fails on any GL error or
/// diagnostic that it has not cleared, and on GL objects left alive.
///
///     TEST_CASE_FIXTURE(GlFixture, "...") { Texture texture(*context, {...}); ... }
struct GlFixture {
    Diagnostics diagnostics;
    std::unique_ptr<GlContext> context =
        createHeadlessContext(diagnostics, GlContext::Options{.debug = true});

    GlFixture() {
        REQUIRE(context);
        context->makeCurrent();
    }

    ~GlFixture() {
        for (const auto& diagnostic : diagnostics.all()) {
            FAIL_CHECK(toString(diagnostic));
        }
        CHECK(context->objectCount() == 0);
    }

    GlFixture(const GlFixture&) = delete;
    GlFixture& operator=(const GlFixture&) = delete;
};

} // namespace terrane
