// SPDX-License-Identifier: BSD-3-Clause
#include "app/player.h"
#include "archive_edits.h"
#include "archive_folder.h"
#include "environment.h"
#include "render/context_attempt.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>

using namespace terrane;
using test::Environment;

namespace {

std::filesystem::path archive(const std::string& name) {
    const char* const source = std::getenv("TERRANE_SOURCE");
    return std::filesystem::path(source ? source : ".") / "archives" / name;
}

PlayerOptions drawnBy(HeadlessKind kind, const std::string& name) {
    return {.archive = archive(name), .width = 160, .height = 120, .debug = true, .headless = kind};
}

void checkSilent(Player& player) {
    for (const Diagnostic& diagnostic : player.diagnostics().all())
        FAIL_CHECK(toString(diagnostic));
}

void checkAgree(const Image& a, const Image& b) {
    const PictureDifference difference = comparePictures(a, b);
    INFO(difference.toString());
    CHECK(difference.agree(kPictureShare));
}

} // namespace

TEST_CASE("OSMesa and EGL draw the same picture") {
    if (!builtWithOsMesa()) {
        MESSAGE("skipped: this build is without OSMesa");
        return;
    }
    for (const char* name : {"quadtree", "mountains"}) {
        CAPTURE(name);
        Player osmesa(standardRegistry(), drawnBy(HeadlessKind::osmesa, name));
        Player egl(standardRegistry(), drawnBy(HeadlessKind::egl, name));
        REQUIRE(osmesa.load());
        REQUIRE(egl.load());
        // Side by side, frame by frame: each makes its own context current.
        while (!osmesa.complete() && osmesa.frames() < kMostFrames) {
            REQUIRE(osmesa.frame());
            REQUIRE(egl.frame());
        }
        CHECK(egl.complete());
        checkAgree(osmesa.capture(), egl.capture());
        checkSilent(osmesa);
        checkSilent(egl);
    }
}

TEST_CASE("two players draw with EGL in one process, and one outlives the other") {
    auto first =
        std::make_unique<Player>(standardRegistry(), drawnBy(HeadlessKind::egl, "quadtree"));
    Player second(standardRegistry(), drawnBy(HeadlessKind::egl, "quadtree"));
    REQUIRE(first->load());
    REQUIRE(second.load());
    REQUIRE(first->drawUntilComplete());
    REQUIRE(second.frame());
    const Image picture = first->capture();
    first.reset();
    REQUIRE(second.drawUntilComplete());
    checkAgree(second.capture(), picture);
    checkSilent(second);
}

TEST_CASE("a picture changes its size between frames") {
    ArchiveFolder folder;
    folder.writeColour("0.0, 0.0, 1.0");
    Player player(standardRegistry(),
                  {.archive = folder.path(), .width = 8, .height = 8, .debug = true});
    REQUIRE(player.load());
    REQUIRE(player.drawUntilComplete());
    player.resize(40, 30);
    CHECK(!player.complete());
    // Until the next frame is drawn, the last one can be seen.
    const Image last = player.capture();
    CHECK(last.width == 8);
    CHECK(int(last.row(7)[2]) == 255);
    REQUIRE(player.frame());
    const Image image = player.capture();
    CHECK(image.width == 40);
    CHECK(image.height == 30);
    for (const int x : {0, 39}) {
        CHECK(int(image.row(29)[x * 3 + 0]) == 0);
        CHECK(int(image.row(29)[x * 3 + 2]) == 255);
    }
    checkSilent(player);
}

TEST_CASE("a player knows the point of the ground below a pixel") {
    Player player(standardRegistry(), drawnBy(HeadlessKind::any, "quadtree"));
    REQUIRE(player.load());
    CHECK(!player.groundAt(80, 60)); // nothing is drawn yet
    player.controller().view = {.x0 = 20, .y0 = -30, .theta = 0.8, .phi = 0.4, .d = 300};
    REQUIRE(player.drawUntilComplete());
    const auto centre = player.groundAt(80, 60);
    REQUIRE(centre);
    CHECK(std::abs(centre->z) < 0.01); // it is ground
    constexpr double kPixel = 4;       // metres there
    CHECK(glm::distance(*centre, glm::dvec3(20, -30, 0)) < kPixel);

    // What is dragged elsewhere stays below the pointer.
    const auto from = player.groundAt(50, 80), to = player.groundAt(90, 100);
    REQUIRE(from);
    REQUIRE(to);
    player.controller().move(*from, *to);
    REQUIRE(player.drawUntilComplete());
    const auto dragged = player.groundAt(90, 100);
    REQUIRE(dragged);
    CHECK(glm::distance(*dragged, *from) < 0.1);

    for (const double outside : {-1.0, 1000.0}) {
        CHECK(!player.groundAt(outside, 60));
        CHECK(!player.groundAt(80, outside));
    }
    player.controller().view = {.theta = 1.5, .d = 5000}; // the ground ends below the sky
    REQUIRE(player.drawUntilComplete());
    CHECK(!player.groundAt(80, 2));
    checkSilent(player);
}

TEST_CASE("ground far from the world's origin is ground, too") {
    ArchiveFolder folder;
    folder.write("quadtree.glsl", edited(archive("quadtree") / "quadtree.glsl", {}));
    const std::string node = "<node name=\"ground\" flags=\"object\">";
    folder.write("archive.xml", edited(archive("quadtree") / "archive.xml",
                                       {{node, node + "<translate x=\"40000\" y=\"-5000\"/>"}}));
    Player player(standardRegistry(), {.archive = folder.path(), .width = 160, .height = 120});
    REQUIRE(player.load());
    player.controller().view = {.x0 = 40020, .y0 = -5030, .theta = 0.8, .phi = 0.4, .d = 300};
    REQUIRE(player.drawUntilComplete());
    const auto centre = player.groundAt(80, 60);
    REQUIRE(centre);
    CHECK(glm::distance(*centre, glm::dvec3(40020, -5030, 0)) < 4);
    checkSilent(player);
}
