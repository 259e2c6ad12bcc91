#pragma once

#include "drivers/gles3/gl/shader_source.h"

#include "core/expected.h"

#include <string_view>

namespace cl::gles3::gl {

/// The first complaint of a driver's compile or link log as a ParseError at its place in the .glsl file.
/// Knows the forms "0:12(3): error: text" (Mesa) and "ERROR: 0:12: text" (Khronos' front end, ANGLE), whose
/// first number is that of the #line directives. A log of another form is given as it is, at the program's
/// file.
[[nodiscard]] Error error_from_shader_log(std::string_view log, const ShaderSource& source);

} // namespace cl::gles3::gl
