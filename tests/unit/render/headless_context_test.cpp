// SPDX-License-Identifier: BSD-3-Clause
#include "render/context_attempt.h"

#include <doctest/doctest.h>
#include <glad/gl.h>

#include <string>
#include <thread>
#include <vector>

using namespace terrane;

namespace {

struct System {
    const char* name;
    HeadlessKind kind;
    ContextAttempt (*attempt)(Diagnostics&, const GlContext::Options&);
};

/// Those that this machine has.
std::vector<System> systems() {
    std::vector<System> list{{"EGL", HeadlessKind::egl, tryEglContext}};
    if (builtWithOsMesa()) list.push_back({"OSMesa", HeadlessKind::osmesa, tryOsMesaContext});
    return list;
}

float clearColour(const GlContext& context) {
    GLfloat colour[4];
    context.gl().GetFloatv(GL_COLOR_CLEAR_VALUE, colour);
    return colour[0];
}

} // namespace

TEST_CASE("every system offers OpenGL 4.5 core, with its errors told") {
    for (const System& system : systems()) {
        CAPTURE(system.name);
        Diagnostics diagnostics;
        const auto context = createHeadlessContext(diagnostics, {.debug = true}, system.kind);
        REQUIRE(context);
        CHECK(diagnostics.all().empty());
        CHECK(context->system() == std::string(system.name));
        CHECK(context->isCurrent());
        GLint profile = 0;
        context->gl().GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
        CHECK(profile == GL_CONTEXT_CORE_PROFILE_BIT);
        context->gl().Enable(0xDEAD);
        REQUIRE(diagnostics.errors() == 1);
        CHECK(diagnostics.all()[0].code == "gl-error");
    }
}

TEST_CASE("contexts of all systems stand side by side in one thread") {
    Diagnostics diagnostics;
    std::vector<std::unique_ptr<GlContext>> contexts;
    for (int copy = 0; copy < 2; ++copy) {
        for (const System& system : systems())
            contexts.push_back(system.attempt(diagnostics, {.debug = true}).context);
    }
    // Each time another one, and back: what one is told the others do not hear.
    for (std::size_t i = 0; i < contexts.size(); ++i) {
        REQUIRE(contexts[i]);
        contexts[i]->makeCurrent();
        contexts[i]->gl().ClearColor(0.125F * float(i + 1), 0, 0, 1);
    }
    for (std::size_t step = 0; step < 3 * contexts.size(); ++step) {
        const std::size_t i = step * 3 % contexts.size();
        CAPTURE(i);
        contexts[i]->makeCurrent();
        CHECK(contexts[i]->isCurrent());
        CHECK(clearColour(*contexts[i]) == 0.125F * float(i + 1));
    }
    contexts[0].reset(); // the others live on, whichever is current
    for (std::size_t i = 1; i < contexts.size(); ++i) {
        contexts[i]->makeCurrent();
        CHECK(clearColour(*contexts[i]) == 0.125F * float(i + 1));
        contexts[i].reset();
    }
    CHECK(diagnostics.all().empty());
}

TEST_CASE("a context goes from thread to thread, to one at a time") {
    for (const System& system : systems()) {
        CAPTURE(system.name);
        Diagnostics diagnostics;
        auto context = createHeadlessContext(diagnostics, {.debug = true}, system.kind);
        REQUIRE(context);
        context->gl().ClearColor(0.5F, 0, 0, 1);
        context->leave();
        CHECK(!context->isCurrent());
        float colour = 0;
        std::thread([&] {
            context->makeCurrent();
            colour = clearColour(*context);
            context->leave();
        }).join();
        CHECK(colour == 0.5F);
        context->makeCurrent();
        CHECK(clearColour(*context) == 0.5F);
        CHECK(diagnostics.all().empty());
    }
}
