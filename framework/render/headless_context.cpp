// SPDX-License-Identifier: BSD-3-Clause
#include "render/context_attempt.h"

namespace terrane {

namespace {

struct Kind {
    const char* name;
    ContextAttempt (*attempt)(Diagnostics&, const GlContext::Options&);
};

constexpr Kind kOsMesa{"OSMesa", tryOsMesaContext};
constexpr Kind kEgl{"EGL", tryEglContext};

bool egl(HeadlessKind kind) {
    return kind == HeadlessKind::egl || (kind == HeadlessKind::any && !builtWithOsMesa());
}

} // namespace

std::unique_ptr<GlContext> createHeadlessContext(Diagnostics& diagnostics,
                                                 const GlContext::Options& options,
                                                 HeadlessKind kind) {
    const Kind& wanted = egl(kind) ? kEgl : kOsMesa;
    const Kind& other = egl(kind) ? kOsMesa : kEgl;
    ContextAttempt first = wanted.attempt(diagnostics, options);
    if (first.context) return std::move(first.context);
    ContextAttempt second = other.attempt(diagnostics, options);
    if (second.context) {
        diagnostics.warning("context-fallback", {},
                            first.fault + "; drawing with " + other.name + " instead",
                            kOpenGlNeeded);
        return std::move(second.context);
    }
    diagnostics.error("no-context", {}, first.fault + "; " + second.fault, kOpenGlNeeded);
    return nullptr;
}

} // namespace terrane
