// SPDX-License-Identifier: BSD-3-Clause
#include "ui/view_handler.h"

#include "ui/view_controller.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/gtc/constants.hpp>
#include <limits>

using namespace terrane;
using doctest::Approx;

namespace {

constexpr Modifiers kControl{.control = true};
constexpr double kFrame = 0.02; ///< seconds; the original steps once in as long

/// A flat ground of which each pixel shows a metre, and a light that remembers its turns.
struct World {
    TerrainViewController controller;
    glm::dvec2 light{0};
    int asked = 0; ///< for the ground
    ViewHandler handler{
        controller,
        {[this](double x, double y) -> std::optional<glm::dvec3> {
             ++asked;
             if (y < 0) return std::nullopt; // the sky
             return glm::dvec3(x, -y, 0);
         },
         [this](double azimuth, double elevation) { light += glm::dvec2(azimuth, elevation); }}};

    World() { controller.view = {.x0 = 100, .y0 = 200, .theta = 1, .phi = 0.5, .d = 1000}; }

    View& view() { return controller.view; }
    bool press(MouseButton button, double x, double y, Modifiers modifiers = {}) {
        return handler.handle(MouseButtonEvent{button, true, x, y, modifiers});
    }
    bool release(MouseButton button, double x, double y) {
        return handler.handle(MouseButtonEvent{button, false, x, y, {}});
    }
    bool move(double x, double y) { return handler.handle(MouseMoveEvent{x, y}); }
    void hold(Key key, double seconds, double frame = kFrame) {
        handler.handle(KeyEvent{key, true, {}});
        for (double t = 0; t < seconds - frame / 2; t += frame)
            handler.advance(frame);
        handler.handle(KeyEvent{key, false, {}});
        const View before = controller.view;
        handler.advance(frame);
        CHECK(controller.view == before); // once released
    }
};

} // namespace

TEST_CASE_FIXTURE(World, "the left button drags the ground") {
    CHECK(!move(5, 5)); // nothing is held yet
    CHECK(press(MouseButton::left, 10, 20));
    handler.advance(kFrame);
    CHECK(view().x0 == 100);
    CHECK(asked == 0);
    CHECK(move(15, 22));
    CHECK(move(17, 25));
    CHECK(view().x0 == 100); // the next frame moves it, once
    handler.advance(kFrame);
    CHECK(asked == 2);
    CHECK(view().x0 == 93);
    CHECK(view().y0 == 205);
    move(18, 25);
    CHECK(release(MouseButton::left, 20, 25)); // the last way counts, too
    CHECK(view().x0 == 90);
    move(200, 200);
    handler.advance(kFrame);
    CHECK(view().x0 == 90);
    CHECK(view().phi == 0.5);
    CHECK(view().theta == 1);
}

TEST_CASE_FIXTURE(World, "the sky can't be dragged") {
    press(MouseButton::left, 10, 20);
    move(10, -5);
    handler.advance(kFrame);
    CHECK(view().y0 == 200);
    move(30, 10); // back from the sky
    handler.advance(kFrame);
    CHECK(view().y0 == 200);
    move(30, 15);
    handler.advance(kFrame);
    CHECK(view().y0 == 205);
}

TEST_CASE("control and any button turn the view") {
    for (const MouseButton button : {MouseButton::left, MouseButton::middle, MouseButton::right}) {
        World world;
        CHECK(world.press(button, 100, 100, kControl));
        world.move(150, 75); // 500 pixels are a radian
        world.handler.advance(kFrame);
        CHECK(world.view().phi == Approx(0.4));
        CHECK(world.view().theta == Approx(1.05));
        world.move(150, 10000);
        world.handler.advance(kFrame);
        CHECK(world.view().theta == -glm::pi<double>());
        world.move(150, -10000);
        world.handler.advance(kFrame);
        CHECK(world.view().theta == glm::pi<double>());
        CHECK(world.view().x0 == 100);
        CHECK(world.asked == 0);
    }
}

TEST_CASE("the middle and the right button move the light") {
    for (const MouseButton button : {MouseButton::middle, MouseButton::right}) {
        World world;
        const View before = world.view();
        CHECK(world.press(button, 0, 0));
        world.move(40, -80); // a quarter of a degree a pixel
        world.handler.advance(kFrame);
        CHECK(world.light.x == Approx(glm::radians(10.0)));
        CHECK(world.light.y == Approx(glm::radians(20.0)));
        CHECK(world.view() == before);
    }
}

TEST_CASE_FIXTURE(World, "only the button that began a drag ends it") {
    press(MouseButton::left, 0, 0);
    CHECK(!press(MouseButton::right, 0, 0));
    CHECK(!release(MouseButton::right, 0, 0));
    CHECK(move(1, 0));
    handler.advance(kFrame);
    CHECK(view().x0 == 99);
    CHECK(release(MouseButton::left, 1, 0));
    CHECK(!release(MouseButton::left, 1, 0));
    CHECK(!press(MouseButton::left, 0, 0, {.shift = true})); // left to others
    CHECK(!move(9, 0));
}

TEST_CASE_FIXTURE(World, "the wheel goes nearer and farther by a fifth") {
    CHECK(handler.handle(WheelEvent{1, {}}));
    CHECK(view().d == Approx(1000 / 1.2));
    handler.handle(WheelEvent{-3, {}});
    CHECK(view().d == Approx(1000 * 1.44));
    handler.handle(WheelEvent{1e9, {}}); // and never ends up where no factor leads back from
    CHECK(view().d > 0);
    handler.handle(WheelEvent{-1e9, {}});
    CHECK(std::isfinite(view().d));
}

TEST_CASE("keys that are held move the view") {
    World world;
    world.hold(Key::pageUp, 1); // 50 steps of 2 %
    CHECK(world.view().d == Approx(1000 * std::pow(1.02, 50)));
    world.hold(Key::pageDown, 1);
    CHECK(world.view().d == Approx(1000));
    world.hold(Key::pageDown, 1, 1); // a slow frame is one step
    CHECK(world.view().d == Approx(1000 / 1.02));

    World ahead;
    const double speed = ahead.controller.height();
    ahead.hold(Key::up, 0.5);
    CHECK(ahead.view().x0 == Approx(100 - std::sin(0.5) * speed / 2));
    CHECK(ahead.view().y0 == Approx(200 + std::cos(0.5) * speed / 2));
    ahead.hold(Key::down, 0.5);
    CHECK(ahead.view().x0 == Approx(100));

    World turned;
    const glm::dvec3 position = turned.controller.position();
    turned.hold(Key::left, 1);
    CHECK(turned.view().phi == Approx(1)); // half a radian a second
    CHECK(glm::distance(turned.controller.position(), position) < 1e-6);
    turned.hold(Key::right, 2);
    CHECK(turned.view().phi == Approx(0));
}

TEST_CASE_FIXTURE(World, "what means nothing to it is left to others") {
    const View before = view();
    CHECK(!handler.handle(KeyEvent{Key::f5, true, {}}));
    CHECK(!handler.handle(KeyEvent{Key::escape, true, {}}));
    CHECK(!handler.handle(TextEvent{U'a'}));
    handler.advance(kFrame);
    CHECK(view() == before);
}

TEST_CASE("without surroundings, drags do nothing") {
    TerrainViewController controller;
    ViewHandler handler(controller, {});
    const View before = controller.view;
    for (const MouseButton button : {MouseButton::left, MouseButton::right}) {
        handler.handle(MouseButtonEvent{button, true, 0, 0, {}});
        handler.handle(MouseMoveEvent{10, 10});
        handler.advance(kFrame);
        handler.handle(MouseButtonEvent{button, false, 10, 10, {}});
    }
    CHECK(controller.view == before);
}
