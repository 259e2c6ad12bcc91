#pragma once

#include "drivers/window.h"

#include "core/expected.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace cl::drivers {

/// Where a GL context can come from. All give GLSL `#version 300 es` and the GLES 3.0 entry points.
enum class DriverKind : uint8_t {
    Egl,    ///< off screen, OpenGL ES 3 from EGL; needs no display
    Osmesa, ///< off screen, OpenGL 4.5 core from libOSMesa, which is loaded at run time if it is there
    Window, ///< OpenGL ES 3 in a GLFW window; needs a display
};

/// The name on the command line: "egl", "osmesa", "window".
[[nodiscard]] std::string_view driver_name(DriverKind kind) noexcept;
/// @return InvalidArgument naming the choices.
[[nodiscard]] Expected<DriverKind> driver_from_name(std::string_view name);

/// A GL context, current on the thread that made it, and its debug output. It must outlive every GL object.
class GLContext {
public:
    virtual ~GLContext();
    GLContext(const GLContext&) = delete;
    GLContext& operator=(const GLContext&) = delete;

    [[nodiscard]] virtual DriverKind kind() const noexcept = 0;
    /// Directs all GL calls of this thread here. Entry points are reloaded if another driver's were in place.
    [[nodiscard]] Status make_current();
    /// Size of the window's framebuffer [pixels]; (0, 0) off screen, where framebuffer 0 must not be drawn
    /// to.
    [[nodiscard]] virtual glm::ivec2 size() const = 0;
    /// Shows what was drawn to framebuffer 0; nothing off screen.
    virtual void swap() {}
    /// Input and title; nullptr off screen. Lives as long as the context.
    [[nodiscard]] virtual Window* window() noexcept { return nullptr; }

    /// Errors of GL so far: debug messages of medium or high severity, and glGetError where there is no debug
    /// output. Each was logged. Tests expect 0.
    [[nodiscard]] int error_count();

    [[nodiscard]] const std::string& renderer() const noexcept { return renderer_; }       ///< GL_RENDERER
    [[nodiscard]] const std::string& api_version() const noexcept { return api_version_; } ///< GL_VERSION

protected:
    using Proc = void (*)();
    GLContext() = default;
    [[nodiscard]] virtual Status make_current_raw() = 0;
    virtual void release_current_raw() = 0;
    [[nodiscard]] virtual Proc proc_address(const char* name) const = 0;

private:
    friend Expected<std::unique_ptr<GLContext>> finish_context(std::unique_ptr<GLContext> context);
    Status load_entry_points();
    void enable_debug_output();
    void count_error(std::string_view text);

    std::string renderer_, api_version_;
    bool has_debug_output_ = false;
    int errors_ = 0;
};

/// Only read by DriverKind::Window.
struct WindowDesc {
    glm::ivec2 size{1024, 600};
    std::string title = "Conelight";
};

/// Starts one driver and makes its context current.
/// @return Unsupported with one line that says what is missing ("egl: ...").
[[nodiscard]] Expected<std::unique_ptr<GLContext>> create_context(DriverKind kind,
                                                                  const WindowDesc& window = {});

/// The first off-screen driver that starts: egl, then osmesa. Never opens a window.
/// @return Unsupported with what each driver said.
[[nodiscard]] Expected<std::unique_ptr<GLContext>> create_offscreen_context();

} // namespace cl::drivers
