#pragma once

#include "servers/gi/center_test.h"
#include "servers/gi/voxelizer.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cl::gi {

/// A triangle of the bake, in probe-local metres, with what every leaf that it touches needs of it.
struct PlotTriangle {
    glm::vec3 v[3];
    glm::vec3 plane_normal; ///< clockwise-front convention; 0 for a degenerate triangle
    float plane_d;          ///< dot(plane_normal, v[0])
    uint32_t surface;       ///< index into the bake's surfaces
    uint32_t vertex[3];     ///< indices into that surface's arrays
    uint8_t axis;           ///< dominant axis of the plane normal
    /// Every sample of this triangle is the same to the bit: one texel of material, one normal that
    /// interpolation cannot move. Lets most walls skip the interpolation (spec gi-bake section 5, steps 2 to
    /// 6).
    bool is_uniform;
    CenterTest center_test;
};

/// The triangles of all surfaces that touch `box`, in plot order (surface after surface, triangle after
/// triangle; spec gi-bake section 4). Triangles with a coordinate that is not finite or beyond 1e12 m are
/// left out: their separating-axis test would overflow and find them everywhere.
/// @param leaf_m  edge of a leaf: triangles that are smaller get no center_test
/// @return InvalidArgument where arrays do not fit together; OutOfMemory beyond 2^31 triangles.
[[nodiscard]] Expected<std::vector<PlotTriangle>> collect_triangles(std::span<const PlotSurface> surfaces,
                                                                    const AABB& box, float leaf_m);

} // namespace cl::gi
