// SPDX-License-Identifier: BSD-3-Clause
#include "render/context_attempt.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdio>
#include <string_view>
#include <vector>

namespace terrane {

namespace {

/// Whether a word stands in a list that is separated by blanks.
bool lists(const char* words, std::string_view word) {
    std::string_view rest = words ? words : "";
    while (!rest.empty()) {
        const std::size_t end = rest.find(' ');
        if (rest.substr(0, end) == word) return true;
        if (end == std::string_view::npos) break;
        rest.remove_prefix(end + 1);
    }
    return false;
}

std::string failed(const char* function) {
    char code[16];
    std::snprintf(code, sizeof code, "0x%x", unsigned(eglGetError()));
    return "fails in " + std::string(function) + " (EGL error " + code + ")";
}

class EglContext final : public GlContext {
public:
    /// Displays belong to the process and are not closed: another player's context may be on the
    /// same one.
    EglContext(Diagnostics& diagnostics, EGLDisplay display)
        : GlContext(diagnostics)
        , display_(display) {}

    ~EglContext() override {
        leave();
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    }

    /// Why it can't be made; empty when it is.
    std::string create(const Options& options) {
        if (!eglInitialize(display_, nullptr, nullptr)) return failed("eglInitialize");
        const char* const extensions = eglQueryString(display_, EGL_EXTENSIONS);
        if (!lists(extensions, "EGL_KHR_surfaceless_context"))
            return "has no contexts without a surface";
        if (!eglBindAPI(EGL_OPENGL_API)) return "has no OpenGL";
        EGLConfig config = nullptr; // EGL_NO_CONFIG_KHR
        if (!lists(extensions, "EGL_KHR_no_config_context") && !chooseConfig(config))
            return "has no configuration for OpenGL";
        // An older one only tells what there is.
        if (!create(config, 4, 5, options.debug) && !create(config, 3, 2, options.debug))
            return failed("eglCreateContext");
        if (!enter()) return failed("eglMakeCurrent");
        const std::string fault = initialise(eglGetProcAddress, options);
        return fault.empty() ? fault : "has " + fault;
    }

    const char* system() const override { return "EGL"; }

protected:
    bool bind() override {
        // The API is a setting of the thread.
        return eglBindAPI(EGL_OPENGL_API) &&
               eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
    }
    void release() override {
        eglBindAPI(EGL_OPENGL_API);
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

private:
    bool chooseConfig(EGLConfig& config) const {
        const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                 EGL_NONE};
        EGLint count = 0;
        return eglChooseConfig(display_, wanted, &config, 1, &count) && count == 1;
    }

    bool create(EGLConfig config, EGLint major, EGLint minor, bool debug) {
        const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, major, EGL_CONTEXT_MINOR_VERSION, minor,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 // EGL 1.4 knows the profile from an extension, but not this.
                                 debug ? EGL_CONTEXT_OPENGL_DEBUG : EGL_NONE, EGL_TRUE, EGL_NONE};
        context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, wanted);
        return context_ != EGL_NO_CONTEXT;
    }

    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

/// A way to get at a renderer.
struct Renderer {
    std::string name;
    EGLDisplay display = EGL_NO_DISPLAY;
    bool software = false; ///< known to be, before a context is made
};

void addDevices(const char* extensions, std::vector<Renderer>& renderers) {
    const bool devices =
        lists(extensions, "EGL_EXT_device_base") || lists(extensions, "EGL_EXT_device_enumeration");
    if (!devices || !lists(extensions, "EGL_EXT_platform_device")) return;
    const auto queryDevices =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto queryString = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
        eglGetProcAddress("eglQueryDeviceStringEXT"));
    EGLint count = 0;
    if (!queryDevices || !queryDevices(0, nullptr, &count) || count < 1) return;
    std::vector<EGLDeviceEXT> found(static_cast<std::size_t>(count));
    if (!queryDevices(count, found.data(), &count)) return;
    found.resize(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < found.size(); ++i) {
        const char* const kind = queryString ? queryString(found[i], EGL_EXTENSIONS) : nullptr;
        renderers.push_back({"device " + std::to_string(i),
                             eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, found[i], nullptr),
                             lists(kind, "EGL_MESA_device_software")});
    }
}

std::vector<Renderer> renderers() {
    const char* const extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<Renderer> list;
    if (lists(extensions, "EGL_MESA_platform_surfaceless")) {
        void* const whichever = EGL_DEFAULT_DISPLAY;
        list.push_back({"surfaceless",
                        eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, whichever, nullptr)});
    }
    addDevices(extensions, list);
    return list;
}

} // namespace

ContextAttempt tryEglContext(Diagnostics& diagnostics, const GlContext::Options& options) {
    ContextAttempt best;
    std::string faults;
    for (const Renderer& renderer : renderers()) {
        if (best.context && renderer.software) continue;
        auto context = std::make_unique<EglContext>(diagnostics, renderer.display);
        const std::string fault = context->create(options);
        if (!fault.empty()) {
            faults += (faults.empty() ? "EGL " : ", EGL ") + renderer.name + " " + fault;
            continue;
        }
        if (!context->isSoftware()) return {std::move(context), {}};
        if (!best.context) best.context = std::move(context);
    }
    if (best.context)
        best.context->makeCurrent();
    else
        best.fault = faults.empty() ? "EGL has no surfaceless platform and no devices" : faults;
    return best;
}

} // namespace terrane
