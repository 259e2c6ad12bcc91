#pragma once

#include "drivers/gl_context.h"

namespace cl::glfw {

/// OpenGL ES 3 in a window, by EGL. One at a time, on the main thread.
/// @return Unsupported, "window: ..." (no display, no driver, or there is a window already).
[[nodiscard]] Expected<std::unique_ptr<drivers::GLContext>> create_context(const drivers::WindowDesc& desc);

} // namespace cl::glfw
