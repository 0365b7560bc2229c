// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"

#include <memory>
#include <string>

namespace terrane {

/// A context, or why there is none, for people to read. What each kind of context offers to
/// createHeadlessContext, which chooses between them and reports.
struct ContextAttempt {
    std::unique_ptr<GlContext> context;
    std::string fault;
};

/// False where this build is without OSMesa, which newer versions of Mesa no longer have.
bool builtWithOsMesa();
ContextAttempt tryOsMesaContext(Diagnostics& diagnostics, const GlContext::Options& options);

/// EGL without a surface: Mesa's surfaceless platform, then the devices that EGL enumerates. A
/// graphics processor is preferred to a renderer in software.
ContextAttempt tryEglContext(Diagnostics& diagnostics, const GlContext::Options& options);

} // namespace terrane
