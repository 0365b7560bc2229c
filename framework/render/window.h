// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/input_event.h"
#include "render/context.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace terrane {

class Framebuffer;

/// A window of the desktop, and the context that draws into it. Pictures are drawn into framebuffer
/// objects like without a window, then presented. Several may be open. To be used on the program's
/// main thread only, which GLFW asks for.
///
///     const auto window = Window::open({.title = "Terrane"}, diagnostics, {});
///     while (window && !window->closing()) {
///         for (const InputEvent& event : window->poll()) ...
///         draw(target, window->width(), window->height());
///         window->present(target.framebuffer());
///     }
class Window final : public GlContext {
public:
    struct Options {
        int width = 1024, height = 768; ///< in units of the desktop, which may be several pixels
        std::string title;
    };

    /// Null with a diagnostic, "no-window" without a display and "no-context" without OpenGL 4.5.
    static std::unique_ptr<Window> open(const Options& window, Diagnostics& diagnostics,
                                        const GlContext::Options& context);
    ~Window() override;

    /// Of what is drawn, pixels; both 0 while it is minimised.
    int width() const { return width_; }
    int height() const { return height_; }
    /// Its close button was pressed, or close() called.
    bool closing() const;
    void close();

    /// Lets the desktop tell what has happened since the last time. Valid until the next call.
    const std::vector<InputEvent>& poll();
    /// Sleeps until something happens.
    const std::vector<InputEvent>& wait();
    /// The same, but at most so many seconds.
    const std::vector<InputEvent>& wait(double seconds);
    /// Shows the read buffer of a framebuffer of width x height pixels, stretched over the window,
    /// at the display's rate.
    void present(const Framebuffer& picture, int width, int height);

    const char* system() const override { return "GLFW"; }

protected:
    bool bind() override;
    void release() override;

private:
    struct Listener; ///< what GLFW calls

    explicit Window(Diagnostics& diagnostics);
    bool create(const Options& options, bool debug);
    bool create(const Options& options, bool debug, int major, int minor);
    void add(const InputEvent& event) { events_.push_back(event); }
    void measure();
    void point(double x, double y);

    GLFWwindow* window_ = nullptr;
    std::vector<InputEvent> events_;
    int width_ = 0, height_ = 0;
    std::pair<double, double> pointer_; ///< pixels
    bool resized_ = false;              ///< since the last picture
};

} // namespace terrane
