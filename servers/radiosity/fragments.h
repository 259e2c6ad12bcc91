#pragma once

#include "servers/radiosity/cell_index.h"
#include "servers/radiosity/polygon.h"
#include "servers/radiosity/still_scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

/// A face on the border of two cells belongs to the one behind it, whatever rounding says: all places are
/// taken this far behind their face [cells].
inline constexpr float kNudge_cells = 1e-3f;

/// A piece of a triangle in a cell.
struct Fragment {
    uint64_t order; ///< its cell's CellGrid::order()
    uint32_t triangle;
    float area_cells;
    glm::vec3 centroid; ///< [m]
    uint8_t grid;
    bool back; ///< the back side of a two-sided surface
};

/// Cuts the triangles of a scene at the cells of its grids; sorted by grid, cell, triangle and side.
/// @param probe_count  grids that are cut in full; the others hold only what no grid before them does
[[nodiscard]] std::vector<Fragment> cut_fragments(const StillScene& scene, std::span<const CellGrid> grids,
                                                  size_t probe_count);
/// Where each cell's run of fragments begins, and the end.
[[nodiscard]] std::vector<size_t> cell_starts(std::span<const Fragment> all);

/// The side of the triangle that a fragment is of: its unit normal.
[[nodiscard]] glm::vec3 facing_of(const StillScene& scene, const Fragment& fragment) noexcept;
/// The polygon of a fragment [cells].
[[nodiscard]] Polygon outline(const StillScene& scene, const CellGrid& grid,
                              const Fragment& fragment) noexcept;
/// The centroid's weights of the triangle's second and third corner, 0 to 1.
[[nodiscard]] glm::vec2 barycentric(const StillScene& scene, const Fragment& fragment) noexcept;

} // namespace cl::radiosity
