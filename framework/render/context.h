// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"

#include <cstdint>
#include <memory>
#include <string>

struct GladGLContext;

namespace terrane {

class StateTracker;

/// An OpenGL 4.5 core context with its own function table, so that several live in one process, of
/// the same or of different systems. Every GL object keeps a reference to the context it was made
/// in and must not outlive it. All GL calls happen on the thread that made the context current; a
/// context is current on one thread at a time.
class GlContext {
public:
    struct Options {
        bool debug = false; ///< synchronous debug output; errors become diagnostics ("gl-error")
        /// Cap on anisotropic filtering; 0 means the driver's limit, or 1 on a software renderer.
        float maxAnisotropy = 0;
    };

    virtual ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// Makes this the calling thread's current context (cheap when it already is).
    void makeCurrent();
    bool isCurrent() const;
    /// Leaves the thread without a current context if this is it, so that another thread may use
    /// this one, or destroy it. Destructors of subclasses call it, too, while release() works.
    void leave();
    /// Where it comes from: "OSMesa", "EGL", "GLFW".
    virtual const char* system() const = 0;
    /// Waits until everything that was sent has been done.
    void finish() const;

    /// The functions of this context. Only render/ includes glad's header and calls them.
    const GladGLContext& gl() const { return *gl_; }

    /// What is bound and how the pipeline is set up: bindings and draw state go through this.
    StateTracker& state() const { return *state_; }

    const std::string& renderer() const { return renderer_; } ///< GL_RENDERER
    bool isSoftware() const { return software_; }             ///< llvmpipe, softpipe, swrast
    Diagnostics& diagnostics() const { return diagnostics_; }
    int maxArrayLayers() const { return maxArrayLayers_; }
    float maxAnisotropy() const { return maxAnisotropy_; } ///< the cap, see Options
    /// A number that was never given before, to tell GL objects apart although names are reused.
    std::uint64_t nextSerial() const { return ++serial_; }
    /// GL names alive, for `memory.gl_objects` of the metrics.
    int objectCount() const { return objectCount_; }
    void countObject(int difference) const { objectCount_ += difference; }

protected:
    using Loader = void (*(*)(const char* name))();

    explicit GlContext(Diagnostics& diagnostics);
    /// Loads the function table and reads the limits, with the context current. Below GL 4.5 it
    /// says what there is instead ("OpenGL 3.3 (softpipe)"); empty when all is well.
    std::string initialise(Loader loader, const Options& options);
    /// makeCurrent() without a diagnostic when it fails.
    bool enter();
    /// Tell the system that the context is the thread's current one, or that none is.
    virtual bool bind() = 0;
    virtual void release() = 0;

private:
    Diagnostics& diagnostics_;
    std::unique_ptr<GladGLContext> gl_;
    std::unique_ptr<StateTracker> state_;
    std::string renderer_;
    bool software_ = false;
    int maxArrayLayers_ = 0;
    float maxAnisotropy_ = 1;
    mutable int objectCount_ = 0;
    mutable std::uint64_t serial_ = 0;
};

/// What there must be, for messages.
inline constexpr const char* kOpenGlNeeded =
    "OpenGL 4.5 core, which Mesa's llvmpipe and the drivers of graphics processors have";

/// Where a context without a window comes from: Mesa's OSMesa, always in software; EGL without a
/// display, which reaches graphics processors; or whichever there is, OSMesa first.
enum class HeadlessKind { any, osmesa, egl };

/// A context without a window, current. If this kind can't be had the other is tried, and a warning
/// ("context-fallback") says so. Null with a diagnostic ("no-context") when there is neither.
std::unique_ptr<GlContext> createHeadlessContext(Diagnostics& diagnostics,
                                                 const GlContext::Options& options,
                                                 HeadlessKind kind = HeadlessKind::any);

} // namespace terrane
