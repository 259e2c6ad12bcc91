#pragma once

#include "servers/mesh_surface.h"

#include "core/expected.h"
#include "core/variant/variant.h"

namespace cl::scene {

/// The nine entries of a plain surface (spec tscn section 9.2): vertex, normal, tangent, colour, uv, uv2,
/// bones, weights, index; null where absent. 2D positions get z = 0.
/// @return ParseError naming the entry whose type is wrong, or the count if it is not nine. Lengths are not
///         compared with each other here: encode_surface() does.
[[nodiscard]] Expected<SurfaceArrays> surface_arrays_from_variants(const Array& entries);

} // namespace cl::scene
