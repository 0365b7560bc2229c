// SPDX-License-Identifier: BSD-3-Clause
#include "app/player.h"
#include "app/player_window.h"
#include "archive_folder.h"
#include "render/render_target.h"
#include "terrane_program.h"
#include "virtual_display.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>

using namespace terrane;
using test::VirtualDisplay;

namespace {

/// archives/quadtree in a window of a display without a screen.
class QuadtreeWindow {
public:
    QuadtreeWindow() {
        if (!display.running()) return;
        const char* const source = std::getenv("TERRANE_SOURCE");
        PlayerOptions options{.archive = std::filesystem::path(source ? source : ".") /
                                         "archives/quadtree",
                              .width = 160,
                              .height = 120,
                              .view = View{.theta = 40, .d = 400},
                              .debug = true};
        window.install(options);
        player = std::make_unique<Player>(standardRegistry(), options);
        REQUIRE(player->load());
        REQUIRE(shows([] { return true; }));
    }

    /// Draws frames until something holds; false when it does not in time.
    bool shows(const std::function<bool()>& condition) {
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (std::chrono::steady_clock::now() < deadline) {
            if (!window.prepare(*player)) return false;
            REQUIRE(player->frame());
            window.show(*player);
            if (condition()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return false;
    }

    /// What people see is what was drawn.
    bool screenAgrees() const {
        const int width = player->picture().width(), height = player->picture().height();
        return comparePictures(display.screen(width, height), player->capture()).agree(1);
    }

    const View& view() { return player->controller().view; }

    VirtualDisplay display;
    PlayerWindow window{"quadtree"};
    std::unique_ptr<Player> player;
};

bool skipped(const VirtualDisplay& display) {
    if (!display.running()) MESSAGE("skipped: there is no Xvfb");
    return !display.running();
}

bool withoutKeys() {
    const bool without = !VirtualDisplay::act("version");
    if (without) MESSAGE("skipped: there is no xdotool");
    return without;
}

/// Presses Escape in whatever window of ours there is, again and again, from some time on.
class EscapePresses {
public:
    explicit EscapePresses(std::chrono::milliseconds after)
        : thread_([this, after] {
            std::this_thread::sleep_for(after);
            while (!done_) {
                VirtualDisplay::act("search --name ' - Terrane$' mousemove 9 9 key Escape");
                std::this_thread::sleep_for(std::chrono::milliseconds(100));
            }
        }) {}
    ~EscapePresses() {
        done_ = true;
        thread_.join();
    }
    EscapePresses(const EscapePresses&) = delete;
    EscapePresses& operator=(const EscapePresses&) = delete;

private:
    std::atomic<bool> done_{false};
    std::thread thread_;
};

} // namespace

TEST_CASE_FIXTURE(QuadtreeWindow, "a window shows its player's picture and follows the mouse") {
    if (skipped(display)) return;
    CHECK(player->picture().width() == 160);
    CHECK(player->picture().height() == 120);
    CHECK(shows([&] { return player->complete() && screenAgrees(); }));
    if (!VirtualDisplay::act("search --name '^quadtree - Terrane$' windowsize 240 100")) {
        MESSAGE("skipped: there is no xdotool");
        return;
    }
    CHECK(shows([&] { return player->picture().width() == 240; }));
    CHECK(player->picture().height() == 100);
    CHECK(shows([&] { return player->complete() && screenAgrees(); }));

    const double d = view().d;
    REQUIRE(VirtualDisplay::act("mousemove 120 50 click 5"));
    CHECK(shows([&] { return view().d == doctest::Approx(1.2 * d); }));
    REQUIRE(VirtualDisplay::act("click 4"));
    CHECK(shows([&] { return view().d == doctest::Approx(d); }));

    const auto grabbed = player->groundAt(120, 50);
    REQUIRE(grabbed);
    REQUIRE(VirtualDisplay::act("mousedown 1 mousemove 150 70 mouseup 1"));
    CHECK(shows([&] {
        const auto point = player->groundAt(150, 70);
        return point && glm::distance(*point, *grabbed) < 1;
    }));

    const double phi = view().phi, theta = view().theta;
    REQUIRE(VirtualDisplay::act("keydown ctrl mousedown 3 mousemove 100 90 mouseup 3 keyup ctrl"));
    CHECK(shows([&] { return view().phi == doctest::Approx(phi + 0.1); }));
    CHECK(view().theta == doctest::Approx(theta - 0.04));

    REQUIRE(VirtualDisplay::act("keydown Prior"));
    CHECK(shows([&] { return view().d > 1.1 * d; }));
    REQUIRE(VirtualDisplay::act("keyup Prior"));

    REQUIRE(VirtualDisplay::act("key Escape"));
    CHECK(!shows([] { return false; }));
    CHECK(window.closing());
    for (const Diagnostic& diagnostic : player->diagnostics().all())
        FAIL_CHECK(toString(diagnostic));
}

TEST_CASE_FIXTURE(test::TerraneProgram, "play shows frames in a window") {
    const VirtualDisplay display;
    if (skipped(display)) return;
    writeColour("0.0, 0.5, 1.0");
    const std::string play = "play % --size 64x48 ";
    const Result shown = run(play + "--frames 3 --screenshot %/window.png --metrics %/m.json");
    CHECK(shown.status == 0);
    CHECK(run(play + "--headless --frames 3 --screenshot %/headless.png").status == 0);
    CHECK(readFile(*this / "window.png") == readFile(*this / "headless.png"));
    CHECK(readFile(*this / "m.json").value_or("").find("\"size\": [\n    64,\n    48\n") !=
          std::string::npos);

    write("script", "frames 2\nwait tiles\nexpect no-errors\n");
    CHECK(run(play + "--script %/script").status == 0);
    const Result answers = run(play + "--script -", "frames 2\nexpect metric /size/1 == 48\n");
    CHECK(answers.out == "ok\nok\n");

    const test::Environment old("MESA_GL_VERSION_OVERRIDE", "4.1");
    const Result fault = run(play + "--frames 1");
    CHECK(fault.status == 1);
    CHECK(fault.err.find("the display has OpenGL 4.1 (llvmpipe") != std::string::npos);
}

TEST_CASE_FIXTURE(test::TerraneProgram, "Escape ends a script in the middle of a command") {
    const VirtualDisplay display;
    if (skipped(display) || withoutKeys()) return;
    writeColour("0.0, 0.5, 1.0");
    const EscapePresses presses(std::chrono::milliseconds(100));
    const std::string text = "frames 1000000\nmark\n";
    const Result answers = run("play % --size 64x48 --script -", text);
    CHECK(answers.out == "error: stopped before its end\n");
    CHECK(answers.status == 0);
    write("script", text);
    CHECK(run("play % --size 64x48 --script %/script").status == 0);
}

TEST_CASE_FIXTURE(test::TerraneProgram, "a window does not hide errors of an archive") {
    const VirtualDisplay display;
    if (skipped(display)) return;
    writeColour("1.0, 0.5, 0.0");
    std::string scene = kScene;
    scene.insert(scene.find("        <drawMesh"), "        <drawMesh name=\"nothing\"/>\n");
    write("archive.xml", scene);
    const Result result = run("play % --frames 1");
    CHECK(result.status == 1);
    CHECK(result.err.find("archive.xml:5:") != std::string::npos);
    CHECK(run("play % --frames 1 --keep-going").status == 0);
    // What can be drawn is.
    CHECK(run("play % --size 64x48 --frames 1 --screenshot %/part.png").status == 1);
    CHECK(run("play % --size 64x48 --frames 1 --keep-going --screenshot %/whole.png").status == 0);
    REQUIRE(readFile(*this / "part.png"));
    CHECK(readFile(*this / "part.png") == readFile(*this / "whole.png"));
}

TEST_CASE_FIXTURE(test::TerraneProgram, "a window without anything to draw waits to be closed") {
    const VirtualDisplay display;
    if (skipped(display) || withoutKeys()) return;
    write("archive.xml", "<archive/>\n");
    CHECK(run("play % --frames 1").status == 1);
    const std::chrono::milliseconds open(1500);
    const auto begin = std::chrono::steady_clock::now();
    const EscapePresses presses(open);
    const Result result = run("play %");
    CHECK(std::chrono::steady_clock::now() - begin >= open);
    CHECK(result.status == 1);
    CHECK(result.err.find("[no-root]") != std::string::npos);
}

namespace {

/// Until the middle of the screen has a colour, as people see it; false when it does not in time.
bool screenTurns(const VirtualDisplay& display, const std::array<int, 3>& colour) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < deadline) {
        const Image screen = display.screen(160, 120);
        const unsigned char* const p = screen.row(30) + 80 * screen.pixelSize();
        if (std::equal(colour.begin(), colour.end(), p)) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

/// Letters of the colour of errors, in the upper half.
bool showsProblems(const VirtualDisplay& display) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < deadline) {
        const Image screen = display.screen(160, 120);
        int reddish = 0;
        for (int y = 60; y < 120; ++y) {
            for (int x = 0; x < 160; ++x) {
                const unsigned char* const p = screen.row(y) + x * screen.pixelSize();
                reddish += p[0] > 100 && p[0] > 1.7 * p[1] && p[0] > 1.7 * p[2];
            }
        }
        if (reddish > 50) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

} // namespace

TEST_CASE_FIXTURE(test::TerraneProgram, "a window waits for repairs, and shows every save") {
    const VirtualDisplay display;
    if (skipped(display) || withoutKeys()) return;
    writeColour("0.0, 0.0, 1.0");
    write("archive.xml", "<archive>\n<node name=\"scene\"\n"); // saved halfway
    Result result;
    std::thread playing([&] { result = run("play % --size 160x120"); });
    CHECK(showsProblems(display));
    writeColour("0.0, 0.0, 1.0");
    CHECK(screenTurns(display, {0, 0, 255}));
    writeColour("0.0, 1.0, 0.0");
    CHECK(screenTurns(display, {0, 255, 0}));
    write("fill.glsl", "#ifdef _FRAGMENT_\nvoid main() { oops; }\n#endif\n");
    CHECK(showsProblems(display));
    CHECK(screenTurns(display, {0, 255, 0})); // the picture stays
    writeColour("1.0, 0.0, 1.0");
    CHECK(screenTurns(display, {255, 0, 255}));
    CHECK(VirtualDisplay::act("search --name ' - Terrane$' mousemove 9 9 key F5"));
    {
        const EscapePresses presses(std::chrono::milliseconds(100));
        playing.join();
    }
    CHECK(result.status == 0);
    // A problem is told once, even if other files of the folder are written all the time.
    CHECK(result.err.find("[xml-syntax]") == result.err.rfind("[xml-syntax]"));
    CHECK(result.err.find("[xml-syntax]") != std::string::npos);
    CHECK(result.err.find("[glsl-compile]") != std::string::npos);
    CHECK(result.err.find("not reloaded") != std::string::npos);
    CHECK(result.err.find("reloaded 2 resources, 0 tiles to make anew, in ") != std::string::npos);
}
