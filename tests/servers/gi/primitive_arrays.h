#pragma once

#include "servers/mesh_surface.h"

#include "core/math/aabb.h"

namespace cl::tests {

/// A CubeMesh without subdivisions, as the specification's formulas make it (scene-classes section 17).
SurfaceArrays cube_arrays(const glm::vec3& size_m);

/// A SphereMesh of radius 1 and height 2 with 64 segments and 32 rings.
SurfaceArrays sphere_arrays();

/// A QuadMesh: not indexed, facing +z.
SurfaceArrays quad_arrays(const glm::vec2& size_m);

/// What a bake reads: the arrays after default compression.
SurfaceArrays as_stored(const SurfaceArrays& arrays);

} // namespace cl::tests
