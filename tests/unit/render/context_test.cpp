// SPDX-License-Identifier: BSD-3-Clause
#include "gl_fixture.h"

#include <glad/gl.h>

namespace terrane {

TEST_CASE_FIXTURE(GlFixture, "An off-screen context offers OpenGL 4.5 core") {
    GLint profile = 0;
    context->gl().GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    CHECK(profile == GL_CONTEXT_CORE_PROFILE_BIT);
    CHECK(context->isSoftware());
    CHECK(context->maxAnisotropy() == 1);
    CHECK(context->maxArrayLayers() >= 256);
    CHECK(context->isCurrent());
}

TEST_CASE_FIXTURE(GlFixture, "A GL error becomes a diagnostic") {
    context->gl().Enable(0xDEAD);
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].code == "gl-error");
    CHECK(diagnostics.all()[0].message.find("glEnable") != std::string::npos);
    diagnostics.clear();
}

TEST_CASE("The cap on anisotropy can be raised on a software renderer") {
    Diagnostics diagnostics;
    const auto context = createHeadlessContext(diagnostics, {.maxAnisotropy = 4});
    REQUIRE(context);
    CHECK(context->maxAnisotropy() == 4);
}

TEST_CASE_FIXTURE(GlFixture, "Two contexts stand side by side in one thread") {
    const auto other = createHeadlessContext(diagnostics, {.debug = true});
    REQUIRE(other);
    CHECK(other->isCurrent());
    CHECK_FALSE(context->isCurrent());

    GLfloat colour[4];
    other->gl().ClearColor(1, 1, 1, 1);
    context->makeCurrent();
    context->gl().GetFloatv(GL_COLOR_CLEAR_VALUE, colour);
    CHECK(colour[0] == 0);
    other->makeCurrent();
    other->gl().GetFloatv(GL_COLOR_CLEAR_VALUE, colour);
    CHECK(colour[0] == 1);
    context->makeCurrent();
}

} // namespace terrane
