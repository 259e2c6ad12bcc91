#include "drivers/egl/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/core.h>

#include <string>
#include <string_view>
#include <utility>

namespace cl::egl {

namespace {

constexpr EGLint kContextAttributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0,
                                         EGL_NONE};

Error egl_error(std::string_view what) {
    return {ErrorCode::Unsupported, fmt::format("egl: {} (error 0x{:04x})", what, eglGetError())};
}

/// `extensions` is EGL's space-separated list, or null.
bool has_extension(const char* extensions, std::string_view wanted) {
    for (std::string_view rest = extensions ? extensions : ""; !rest.empty();) {
        const size_t space = rest.find(' ');
        if (rest.substr(0, space) == wanted) {
            return true;
        }
        rest = space == std::string_view::npos ? std::string_view{} : rest.substr(space + 1);
    }
    return false;
}

class EglContext final : public drivers::GLContext {
public:
    EglContext(EGLDisplay display, EGLSurface surface, EGLContext context)
        : display_(display), surface_(surface), context_(context) {}
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext() override {
        if (eglGetCurrentContext() == context_) {
            release_current();
        }
        eglDestroyContext(display_, context_);
        if (surface_ != EGL_NO_SURFACE) {
            eglDestroySurface(display_, surface_);
        }
        // No eglTerminate: EGL gives every context the same display and does not count its users.
    }
    [[nodiscard]] drivers::DriverKind kind() const noexcept override { return drivers::DriverKind::Egl; }
    [[nodiscard]] glm::ivec2 size() const override { return glm::ivec2(0); }

protected:
    Status make_current_raw() override {
        if (!eglBindAPI(EGL_OPENGL_ES_API) || !eglMakeCurrent(display_, surface_, surface_, context_)) {
            return egl_error("the context could not be made current");
        }
        return {};
    }
    void release_current_raw() override { release_current(); }
    Proc proc_address(const char* name) const override { return eglGetProcAddress(name); }

private:
    void release_current() { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
    EGLDisplay display_;
    EGLSurface surface_; ///< EGL_NO_SURFACE: surfaceless
    EGLContext context_;
};

/// EGL_NO_DISPLAY if this EGL has no surfaceless platform.
EGLDisplay surfaceless_display() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_MESA_platform_surfaceless")) {
        return EGL_NO_DISPLAY;
    }
    const auto get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        reinterpret_cast<void*>(eglGetProcAddress("eglGetPlatformDisplayEXT")));
    if (!get_platform_display) {
        return EGL_NO_DISPLAY;
    }
    EGLDisplay display = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
        return EGL_NO_DISPLAY;
    }
    const char* of_display = eglQueryString(display, EGL_EXTENSIONS);
    const bool usable = has_extension(of_display, "EGL_KHR_surfaceless_context") &&
                        has_extension(of_display, "EGL_KHR_no_config_context");
    return usable ? display : EGL_NO_DISPLAY;
}

Expected<std::unique_ptr<drivers::GLContext>> create_with_pbuffer() {
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
        return egl_error("no surfaceless platform, and no default display");
    }
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) {
        return egl_error("no OpenGL ES 3 configuration with pbuffers");
    }
    const EGLint smallest[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    EGLSurface surface = eglCreatePbufferSurface(display, config, smallest);
    if (surface == EGL_NO_SURFACE) {
        return egl_error("no pbuffer");
    }
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, kContextAttributes);
    if (context == EGL_NO_CONTEXT) {
        eglDestroySurface(display, surface);
        return egl_error("no OpenGL ES 3 context");
    }
    return std::unique_ptr<drivers::GLContext>(new EglContext(display, surface, context));
}

} // namespace

Expected<std::unique_ptr<drivers::GLContext>> create_context() {
    if (!eglBindAPI(EGL_OPENGL_ES_API)) {
        return egl_error("no OpenGL ES");
    }
    EGLDisplay display = surfaceless_display();
    if (display == EGL_NO_DISPLAY) {
        return create_with_pbuffer();
    }
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kContextAttributes);
    if (context == EGL_NO_CONTEXT) {
        return egl_error("no OpenGL ES 3 context");
    }
    return std::unique_ptr<drivers::GLContext>(new EglContext(display, EGL_NO_SURFACE, context));
}

} // namespace cl::egl
