// SPDX-License-Identifier: BSD-3-Clause
#include "render/context.h"

#include <GL/osmesa.h>

#include <array>

namespace terrane {

namespace {

class OsMesaContext final : public GlContext {
public:
    explicit OsMesaContext(Diagnostics& diagnostics)
        : GlContext(diagnostics) {}

    ~OsMesaContext() override {
        if (!context_) return;
        if (isCurrent()) OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        OSMesaDestroyContext(context_);
    }

    bool create(const Options& options) {
        // Everything is drawn into framebuffer objects, so the default framebuffer needs no planes.
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_DEPTH_BITS,
                                  0,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  4,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  5,
                                  0};
        context_ = OSMesaCreateContextAttribs(attributes, nullptr);
        if (!context_ || !bind()) {
            diagnostics().error("no-context", {}, "OSMesa offers no OpenGL 4.5 core context",
                                "Mesa with llvmpipe");
            return false;
        }
        return initialise(OSMesaGetProcAddress, options);
    }

    void makeCurrent() override {
        if (!isCurrent()) bind();
    }

    bool isCurrent() const override { return context_ && OSMesaGetCurrentContext() == context_; }

private:
    bool bind() {
        return OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_TRUE;
    }

    OSMesaContext context_ = nullptr;
    std::array<unsigned char, 4> pixel_{}; ///< the default framebuffer that OSMesa asks for
};

} // namespace

std::unique_ptr<GlContext> createOsMesaContext(Diagnostics& diagnostics,
                                               const GlContext::Options& options) {
    auto context = std::make_unique<OsMesaContext>(diagnostics);
    if (!context->create(options)) return nullptr;
    return context;
}

} // namespace terrane
