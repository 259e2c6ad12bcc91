#include "drivers/gl_context.h"

#include "drivers/egl/egl_context.h"
#include "drivers/gl_api.h"
#include "drivers/glfw/glfw_context.h"
#include "drivers/osmesa/osmesa_context.h"

#include "core/io/log.h"

#include <fmt/core.h>

#include <array>
#include <optional>

namespace cl::drivers {

namespace {

struct DriverName {
    DriverKind kind;
    std::string_view name;
};
constexpr std::array kDriverNames{DriverName{DriverKind::Egl, "egl"},
                                  DriverName{DriverKind::Osmesa, "osmesa"},
                                  DriverName{DriverKind::Window, "window"}};

/// Messages beyond these are counted only: one fault in a loop must not bury the rest of the log.
constexpr int kMaxLoggedErrors = 16;

/// Whose entry points the loader's global pointers hold. EGL's and OSMesa's differ.
std::optional<DriverKind> loaded_entry_points;

/// The context that GL calls go to. Mesa's EGL and OSMesa share one dispatch table but not their notion of
/// what is current: unless one is released, it takes making its old context current again for done already.
GLContext* current_context = nullptr;

std::string gl_string(GLenum name) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text ? text : "";
}

} // namespace

std::string_view driver_name(DriverKind kind) noexcept {
    for (const DriverName& d : kDriverNames) {
        if (d.kind == kind) {
            return d.name;
        }
    }
    return "";
}

Expected<DriverKind> driver_from_name(std::string_view name) {
    for (const DriverName& d : kDriverNames) {
        if (d.name == name) {
            return d.kind;
        }
    }
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("expected a driver, egl, osmesa or window, found \"{}\"", name)};
}

GLContext::~GLContext() {
    if (current_context == this) {
        current_context = nullptr;
    }
}

Status GLContext::make_current() {
    if (current_context && current_context != this) {
        current_context->release_current_raw();
    }
    current_context = this;
    if (Status s = make_current_raw(); !s) {
        return s;
    }
    if (loaded_entry_points != kind()) {
        return load_entry_points();
    }
    return {};
}

Status GLContext::load_entry_points() {
    const auto lookup = [](void* self, const char* name) -> GLADapiproc {
        return static_cast<const GLContext*>(self)->proc_address(name);
    };
    loaded_entry_points.reset();
    if (!gladLoadGLES2UserPtr(lookup, this) || !GLAD_GL_ES_VERSION_3_0) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: expected OpenGL ES 3.0 or better, found \"{}\"", driver_name(kind()),
                                 glGetString ? gl_string(GL_VERSION) : "")};
    }
    loaded_entry_points = kind();
    return {};
}

void GLContext::count_error(std::string_view text) {
    if (++errors_ <= kMaxLoggedErrors) {
        log_error(fmt::format("{}: {}", driver_name(kind()), text));
    }
}

void GLContext::enable_debug_output() {
    if (!GLAD_GL_KHR_debug || !glDebugMessageCallbackKHR) {
        return;
    }
    const GLDEBUGPROCKHR callback = [](GLenum, GLenum, GLuint, GLenum severity, GLsizei,
                                       const GLchar* message, const void* self) {
        if (severity == GL_DEBUG_SEVERITY_HIGH_KHR || severity == GL_DEBUG_SEVERITY_MEDIUM_KHR) {
            static_cast<GLContext*>(const_cast<void*>(self))->count_error(message);
        }
    };
    glDebugMessageCallbackKHR(callback, this);
    // Synchronous: on this thread, inside the faulty call, so that a debugger's stack shows it.
    glEnable(GL_DEBUG_OUTPUT_KHR);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS_KHR);
    has_debug_output_ = glGetError() == GL_NO_ERROR;
}

int GLContext::error_count() {
    // A lost context would answer with an error for ever.
    for (int i = 0; !has_debug_output_ && i < kMaxLoggedErrors; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR) {
            break;
        }
        count_error(fmt::format("GL error 0x{:04x}", error));
    }
    return errors_;
}

Expected<std::unique_ptr<GLContext>> finish_context(std::unique_ptr<GLContext> context) {
    if (Status s = context->make_current(); !s) {
        return s.error();
    }
    context->renderer_ = gl_string(GL_RENDERER);
    context->api_version_ = gl_string(GL_VERSION);
    context->enable_debug_output();
    log_debug(
        fmt::format("{}: {}, {}", driver_name(context->kind()), context->renderer_, context->api_version_));
    return context;
}

Expected<std::unique_ptr<GLContext>> create_context(DriverKind kind, const WindowDesc& window) {
    Expected<std::unique_ptr<GLContext>> context = [&] {
        switch (kind) {
        case DriverKind::Egl:
            return egl::create_context();
        case DriverKind::Osmesa:
            return osmesa::create_context();
        case DriverKind::Window:
            break;
        }
        return glfw::create_context(window);
    }();
    if (!context) {
        return context.error();
    }
    return finish_context(*std::move(context));
}

Expected<std::unique_ptr<GLContext>> create_offscreen_context() {
    std::string said;
    for (const DriverKind kind : {DriverKind::Egl, DriverKind::Osmesa}) {
        Expected<std::unique_ptr<GLContext>> context = create_context(kind);
        if (context) {
            return context;
        }
        said += (said.empty() ? "" : "; ") + context.error().message;
    }
    return Error{ErrorCode::Unsupported, "no graphics driver could be started: " + said};
}

} // namespace cl::drivers
