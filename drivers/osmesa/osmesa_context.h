#pragma once

#include "drivers/gl_context.h"

namespace cl::osmesa {

/// OpenGL core profile (4.5 of Mesa 22) drawn by the CPU into memory, from libOSMesa.so.8 if it is installed.
/// @return Unsupported, "osmesa: ...".
[[nodiscard]] Expected<std::unique_ptr<drivers::GLContext>> create_context();

} // namespace cl::osmesa
