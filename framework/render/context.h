// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"

#include <cstdint>
#include <memory>
#include <string>

struct GladGLContext;

namespace terrane {

class StateTracker;

/// An OpenGL 4.5 core context with its own function table, so that several live in one process.
/// Every GL object keeps a reference to the context it was made in and must not outlive it. All GL
/// calls happen on the thread that made the context current.
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
    virtual void makeCurrent() = 0;
    virtual bool isCurrent() const = 0;
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
    /// Loads the function table and reads the limits, with the context current. False with a
    /// diagnostic ("gl-version") below GL 4.5.
    bool initialise(Loader loader, const Options& options);

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

/// A context of Mesa's off-screen software renderer: no display, no GPU. Null with a diagnostic
/// ("no-context") when it can't be had.
std::unique_ptr<GlContext> createOsMesaContext(Diagnostics& diagnostics,
                                               const GlContext::Options& options);

} // namespace terrane
