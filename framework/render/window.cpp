// SPDX-License-Identifier: BSD-3-Clause
#include "render/window.h"

#include "render/framebuffer.h"
#include "render/state_tracker.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <optional>
#include <utility>

namespace terrane {

namespace {

/// Windows alive. GLFW itself is global to the process, and its main thread's.
int windows = 0;

std::string glfwFault() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "GLFW does not say why";
}

Modifiers modifiersOf(int bits) {
    return {(bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0,
            (bits & GLFW_MOD_ALT) != 0};
}

std::optional<Key> keyOf(int code) {
    static constexpr std::pair<int, Key> kKeys[] = {
        {GLFW_KEY_ESCAPE, Key::escape},  {GLFW_KEY_ENTER, Key::enter},
        {GLFW_KEY_KP_ENTER, Key::enter}, {GLFW_KEY_TAB, Key::tab},
        {GLFW_KEY_INSERT, Key::insert},  {GLFW_KEY_BACKSPACE, Key::backspace},
        {GLFW_KEY_DELETE, Key::del},     {GLFW_KEY_HOME, Key::home},
        {GLFW_KEY_END, Key::end},        {GLFW_KEY_PAGE_UP, Key::pageUp},
        {GLFW_KEY_UP, Key::up},          {GLFW_KEY_PAGE_DOWN, Key::pageDown},
        {GLFW_KEY_DOWN, Key::down},      {GLFW_KEY_LEFT, Key::left},
        {GLFW_KEY_RIGHT, Key::right}};
    if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F12) return Key(int(Key::f1) + code - GLFW_KEY_F1);
    for (const auto& [known, key] : kKeys) {
        if (known == code) return key;
    }
    return std::nullopt;
}

std::optional<MouseButton> buttonOf(int code) {
    switch (code) {
    case GLFW_MOUSE_BUTTON_LEFT:
        return MouseButton::left;
    case GLFW_MOUSE_BUTTON_MIDDLE:
        return MouseButton::middle;
    case GLFW_MOUSE_BUTTON_RIGHT:
        return MouseButton::right;
    default:
        return std::nullopt;
    }
}

} // namespace

struct Window::Listener {
    static Window& of(GLFWwindow* window) {
        return *static_cast<Window*>(glfwGetWindowUserPointer(window));
    }
    static void key(GLFWwindow* window, int code, int, int action, int bits) {
        if (const auto key = keyOf(code))
            of(window).add(KeyEvent{*key, action != GLFW_RELEASE, modifiersOf(bits)});
    }
    static void character(GLFWwindow* window, unsigned character) {
        of(window).add(TextEvent{character});
    }
    static void button(GLFWwindow* window, int code, int action, int bits) {
        const auto button = buttonOf(code);
        if (!button) return;
        // GLFW asks the desktop where the pointer is by now, which may be long after the press.
        const auto [x, y] = of(window).pointer_;
        of(window).add(MouseButtonEvent{*button, action == GLFW_PRESS, x, y, modifiersOf(bits)});
    }
    static void move(GLFWwindow* window, double x, double y) {
        of(window).point(x, y);
        of(window).add(MouseMoveEvent{of(window).pointer_.first, of(window).pointer_.second});
    }
    static void wheel(GLFWwindow* window, double, double steps) {
        // GLFW tells no modifiers here.
        const auto pressed = [&](int left, int right) {
            return glfwGetKey(window, left) == GLFW_PRESS ||
                   glfwGetKey(window, right) == GLFW_PRESS;
        };
        const Modifiers modifiers{pressed(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
                                  pressed(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
                                  pressed(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)};
        if (steps != 0) of(window).add(WheelEvent{steps, modifiers});
    }
    static void size(GLFWwindow* window, int, int) { of(window).measure(); }
};

Window::Window(Diagnostics& diagnostics)
    : GlContext(diagnostics) {
    ++windows;
}

Window::~Window() {
    leave();
    if (window_) glfwDestroyWindow(window_);
    if (--windows == 0) glfwTerminate();
}

std::unique_ptr<Window> Window::open(const Options& options, Diagnostics& diagnostics,
                                     const GlContext::Options& context) {
    auto window = std::unique_ptr<Window>(new Window(diagnostics));
    if (!glfwInit()) {
        diagnostics.error("no-window", {}, "no window can be opened: " + glfwFault(),
                          "a display; without one, add --headless --screenshot FILE");
        return nullptr;
    }
    std::string fault;
    if (window->create(options, context.debug)) {
        fault = window->enter() ? window->initialise(glfwGetProcAddress, context)
                                : "a context that can't be used";
        if (!fault.empty()) fault = "the display has " + fault;
    } else {
        fault = "no window with OpenGL can be opened: " + glfwFault();
    }
    if (!fault.empty()) {
        diagnostics.error("no-context", {}, fault, kOpenGlNeeded);
        return nullptr;
    }
    glfwSwapInterval(1);
    return window;
}

bool Window::create(const Options& options, bool debug) {
    // An older one only tells what there is.
    return create(options, debug, 4, 5) || create(options, debug, 3, 2);
}

bool Window::create(const Options& options, bool debug, int major, int minor) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug ? GLFW_TRUE : GLFW_FALSE);
    // Pictures come from framebuffer objects.
    for (const int bits : {GLFW_DEPTH_BITS, GLFW_STENCIL_BITS, GLFW_ALPHA_BITS, GLFW_SAMPLES})
        glfwWindowHint(bits, 0);
    window_ =
        glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (!window_) return false;
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, Listener::key);
    glfwSetCharCallback(window_, Listener::character);
    glfwSetMouseButtonCallback(window_, Listener::button);
    glfwSetCursorPosCallback(window_, Listener::move);
    glfwSetScrollCallback(window_, Listener::wheel);
    glfwSetFramebufferSizeCallback(window_, Listener::size);
    measure();
    double x = 0, y = 0;
    glfwGetCursorPos(window_, &x, &y);
    point(x, y);
    return true;
}

bool Window::closing() const {
    return glfwWindowShouldClose(window_) != 0;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

const std::vector<InputEvent>& Window::poll() {
    events_.clear();
    glfwPollEvents();
    return events_;
}

const std::vector<InputEvent>& Window::wait() {
    events_.clear();
    glfwWaitEvents();
    return events_;
}

const std::vector<InputEvent>& Window::wait(double seconds) {
    events_.clear();
    glfwWaitEventsTimeout(seconds);
    return events_;
}

void Window::present(const Framebuffer& picture, int width, int height) {
    // Mesa's software renderers ask for the size of the window when the viewport changes, and only
    // for a bound framebuffer; blitting by name would show a picture cut to the old size.
    if (resized_) state().forget();
    resized_ = false;
    state().bindDrawFramebuffer(0);
    picture.blitToWindow({0, 0, width, height}, {0, 0, width_, height_}, MagFilter::linear);
    glfwSwapBuffers(window_);
}

bool Window::bind() {
    glfwMakeContextCurrent(window_);
    return glfwGetCurrentContext() == window_;
}

void Window::release() {
    glfwMakeContextCurrent(nullptr);
}

void Window::measure() {
    glfwGetFramebufferSize(window_, &width_, &height_);
    resized_ = true;
}

void Window::point(double x, double y) {
    // The pointer moves in units of the desktop.
    int width = 0, height = 0;
    glfwGetWindowSize(window_, &width, &height);
    if (width > 0 && height > 0) pointer_ = {x * width_ / width, y * height_ / height};
}

} // namespace terrane
