#pragma once

#include "servers/mesh_surface.h"

#include "core/expected.h"

#include <glm/vec3.hpp>

#include <memory>
#include <span>
#include <vector>

namespace cl::embree {

/// A surface as rays need it: plain arrays, and corners of triangles in the order that the rasteriser draws
/// them.
struct TriangleSurface {
    SurfaceArrays arrays;
    std::vector<glm::uvec3> triangles; ///< empty for points and lines, which light does not meet
};

/// One entry a surface; shared, so that a scene under way outlives the mesh.
struct TriangleMesh {
    std::vector<std::shared_ptr<const TriangleSurface>> surfaces;
};

/// @return what decode_surface() says of the first bad surface.
[[nodiscard]] Expected<TriangleMesh> triangulate(std::span<const MeshSurface> surfaces);

} // namespace cl::embree
