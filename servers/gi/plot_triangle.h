#pragma once

#include "servers/gi/center_test.h"
#include "servers/gi/leaf_plots.h"
#include "servers/gi/voxelizer.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cl::gi {

class BrickFilter;

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
};

/// A triangle that may cover whole leaves.
struct BroadTriangle {
    uint32_t triangle;
    CenterTest center_test;
};

/// The triangles of all surfaces, numbered in plot order (surface after surface, triangle after triangle;
/// spec gi-bake section 4).
struct PlotTriangles {
    std::unique_ptr<PlotTriangle[]> by_number; ///< those that are neither broad nor small are not set
    std::vector<BroadTriangle> broad;          ///< ascending
    LeafPlots small;                           ///< the leaves that each of the other triangles touches
};

/// Prepares the triangles that touch the grid's box. Those with a coordinate that is not finite or beyond
/// 1e12 m are left out: their separating-axis test would overflow and find them everywhere.
/// @param filter  which triangles matter; null: all
/// @return InvalidArgument where arrays do not fit together; OutOfMemory beyond 2^31 triangles.
[[nodiscard]] Expected<PlotTriangles> collect_triangles(std::span<const PlotSurface> surfaces,
                                                        const Grid& grid,
                                                        const BrickFilter* filter = nullptr);

} // namespace cl::gi
