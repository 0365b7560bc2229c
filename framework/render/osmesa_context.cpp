// SPDX-License-Identifier: BSD-3-Clause
#include "render/context_attempt.h"

#ifdef TERRANE_OSMESA

#include <GL/osmesa.h>

#include <array>

namespace terrane {

namespace {

class OsMesaContext final : public GlContext {
public:
    explicit OsMesaContext(Diagnostics& diagnostics)
        : GlContext(diagnostics) {}

    ~OsMesaContext() override {
        leave();
        if (context_) OSMesaDestroyContext(context_);
    }

    /// Why it can't be made; empty when it is.
    std::string create(const Options& options) {
        // An older one only tells what there is.
        if (!create(4, 5) && !create(3, 2)) return "OSMesa makes no OpenGL core context";
        if (!enter()) return "OSMesa can't use its context";
        const std::string fault = initialise(OSMesaGetProcAddress, options);
        return fault.empty() ? fault : "OSMesa has " + fault;
    }

    const char* system() const override { return "OSMesa"; }

protected:
    bool bind() override {
        return OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_TRUE;
    }
    void release() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

private:
    bool create(int major, int minor) {
        // Everything is drawn into framebuffer objects, so the default framebuffer needs no planes.
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_DEPTH_BITS,
                                  0,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  major,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  minor,
                                  0};
        context_ = OSMesaCreateContextAttribs(attributes, nullptr);
        return context_ != nullptr;
    }

    OSMesaContext context_ = nullptr;
    std::array<unsigned char, 4> pixel_{}; ///< the default framebuffer that OSMesa asks for
};

} // namespace

bool builtWithOsMesa() {
    return true;
}

ContextAttempt tryOsMesaContext(Diagnostics& diagnostics, const GlContext::Options& options) {
    auto context = std::make_unique<OsMesaContext>(diagnostics);
    std::string fault = context->create(options);
    if (!fault.empty()) return {nullptr, std::move(fault)};
    return {std::move(context), {}};
}

} // namespace terrane

#else

namespace terrane {

bool builtWithOsMesa() {
    return false;
}

ContextAttempt tryOsMesaContext(Diagnostics&, const GlContext::Options&) {
    return {nullptr, "this build is without OSMesa"};
}

} // namespace terrane

#endif
