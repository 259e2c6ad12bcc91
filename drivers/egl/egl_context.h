#pragma once

#include "drivers/gl_context.h"

namespace cl::egl {

/// OpenGL ES 3 without a display server: surfaceless where EGL can, else with a pbuffer on EGL's default
/// display.
/// @return Unsupported, "egl: ...".
[[nodiscard]] Expected<std::unique_ptr<drivers::GLContext>> create_context();

} // namespace cl::egl
