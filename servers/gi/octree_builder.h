#pragma once

#include "servers/gi/leaf_sampling.h"
#include "servers/gi/plot_triangle.h"
#include "servers/gi/triangle_box.h"

#include <glm/vec3.hpp>

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace cl::gi {

/// A cell on the way down the tree: a cube, probe-local. Positions add up in float32 from the root (spec
/// gi-bake section 4.2), so a cell's box is reached through its ancestors only.
struct CellBox {
    glm::vec3 position{0.0f}; ///< least corner [m]
    float size_m = 0.0f;
    int level = 0;
    glm::ivec3 origin{0}; ///< [leaf cells]
};
[[nodiscard]] CellBox root_cell(const Grid& grid) noexcept;
/// @param slot  0 to 7; bit 0 is the +x half, bit 1 +y, bit 2 +z.
[[nodiscard]] CellBox child_cell(const Grid& grid, const CellBox& parent, int slot) noexcept;

/// The eight children of a cell as two groups of four boxes (lane: bit 0 x, bit 1 y), lower and upper in z.
struct Octants {
    Boxes<float4> lower;
    Boxes<float4> upper;
    uint8_t inside = 0; ///< bit of each slot whose origin lies inside dims; the others never get cells
};
[[nodiscard]] Octants octants_of(const Grid& grid, const CellBox& parent) noexcept;
/// Bit of each slot inside the grid that the triangle touches.
[[nodiscard]] inline uint8_t touched_octants(const Octants& octants, const glm::vec3 (&vertices)[3],
                                             const CenterTest& center_test) noexcept {
    const float half_m = octants.lower.half[0][0];
    const uint32_t lower = overlapping_boxes(octants.lower, vertices, center_test, half_m);
    const uint32_t upper = overlapping_boxes(octants.upper, vertices, center_test, half_m);
    return uint8_t((lower | (upper << 4)) & octants.inside);
}

/// What a bake's workers share: how many cells there are so far, and whether to stop.
struct BakeControl {
    uint64_t max_cells = 0;
    std::atomic<uint64_t> cell_count{0};
    std::atomic<bool> stop{false};
};

/// A cell without children, colours or opacity.
[[nodiscard]] Cell empty_cell(int level) noexcept;

/// Builds the subtree below one cell. Broad triangles go down the tree together, as a list that each cell
/// filters for its children, and small ones wait at their leaves, so every leaf is finished in one visit and
/// needs no accumulator; the tests' outcomes, the order of sums in a leaf, and hence every bit, are those of
/// descending triangle after triangle.
class SubtreeBuilder {
public:
    SubtreeBuilder(const Grid& grid, std::span<const PlotSurface> surfaces, const PlotTriangles& triangles,
                   BakeControl& control)
        : grid_(grid), surfaces_(surfaces), triangles_(triangles), control_(control) {}

    /// What lies below a cell.
    struct Content {
        std::span<const uint32_t> broad; ///< numbers in PlotTriangles::broad that touch the cell, ascending
        std::span<const LeafPlot> small; ///< of its leaves, by leaf, then triangle
        uint32_t number;                 ///< slots from the root to the cell, three bits a level
    };
    /// Appends the cell and all below it to cells(), parents first, slots in order; child indices count from
    /// the start of cells(). Stops early, with an unusable result, once control.stop is set.
    /// @return the cell's alpha.
    float build(const CellBox& box, const Content& content);

    [[nodiscard]] const std::vector<Cell>& cells() const noexcept { return cells_; }
    [[nodiscard]] std::vector<Cell> take_cells() noexcept { return std::move(cells_); }
    [[nodiscard]] uint32_t leaf_count() const noexcept { return leaf_count_; }

private:
    /// A range of ids_.
    struct List {
        size_t begin = 0;
        size_t count = 0;
    };
    float build_cell(const CellBox& box, uint32_t number, List touching);
    void build_leaf(const CellBox& box, uint32_t number, List touching);
    List push_children_list(List touching, size_t masks_begin, int slot);
    [[nodiscard]] uint32_t octants_with_small(int level, uint32_t number) const;
    void count_cells();

    const Grid& grid_;
    std::span<const PlotSurface> surfaces_;
    const PlotTriangles& triangles_;
    BakeControl& control_;
    LeafSampler sampler_;
    std::vector<Cell> cells_;
    size_t counted_cells_ = 0;
    uint32_t leaf_count_ = 0;
    std::span<const LeafPlot> small_; ///< those of leaves that are not built yet
    // Stacks of the descent: a list of broad triangles and their octant bits for each cell on the path.
    std::vector<uint32_t> ids_;
    std::vector<uint8_t> masks_;
};

} // namespace cl::gi
