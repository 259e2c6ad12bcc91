#pragma once

#include "servers/gi/octree_builder.h"
#include "servers/gi/plot_triangle.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cl::gi {

/// Level of the cells whose children are bricks.
inline constexpr int kBrickParentLevel = kBakeBrickLevel - 1;

/// Which cells something touches, from the root down to the bricks: of each cell above these, a bit a child.
class TopReach {
public:
    /// @param level, number  of the cell: 0 to kBrickParentLevel, slots from the root
    [[nodiscard]] uint8_t& children_of(int level, uint32_t number) noexcept {
        return children_[first_of(level) + number];
    }
    [[nodiscard]] uint8_t children_of(int level, uint32_t number) const noexcept {
        return children_[first_of(level) + number];
    }
    /// A brick and the cells above it.
    void add_brick(uint32_t number) noexcept;
    [[nodiscard]] bool has_brick(uint32_t number) const noexcept {
        return ((children_of(kBrickParentLevel, number / 8) >> (number % 8)) & 1u) != 0;
    }
    /// Whether a brick is in both.
    [[nodiscard]] bool meets(const TopReach& other) const noexcept;
    TopReach& operator|=(const TopReach& other) noexcept;

private:
    /// Cells above a level: 1 + 8 + ...
    static constexpr size_t first_of(int level) { return ((size_t{1} << (3 * level)) - 1) / 7; }
    std::array<uint8_t, ((size_t{1} << (3 * kBakeBrickLevel)) - 1) / 7> children_{};
};

/// A cell above the bricks.
struct TopCell {
    CellBox box;
    uint32_t number;                ///< slots from the root, three bits a level
    std::vector<uint32_t> touching; ///< broad triangles, ascending; emptied once the children have theirs
    std::vector<uint8_t> masks;     ///< octants that each of them touches
    int64_t children[8] = {-1, -1, -1, -1, -1, -1, -1, -1}; ///< top cells, or bricks below kBrickParentLevel
};

/// Where a brick hangs.
struct BrickPlace {
    size_t parent; ///< number in TopCells::cells()
    int slot;
    uint32_t number; ///< slots from the root
};

/// The top of the tree, made one cell after the other; each child below is a brick, built on its own by any
/// worker. Fixed in depth, so that the result does not know how many workers there were.
class TopCells {
public:
    /// Cells that triangles touch.
    /// @param also         cells that are there besides
    /// @param of_surfaces  what each surface's triangles touch is added here; empty: not asked for
    TopCells(const Grid& grid, const PlotTriangles& triangles, const TopReach& also = {},
             std::span<TopReach> of_surfaces = {});

    [[nodiscard]] std::span<const TopCell> cells() const noexcept { return cells_; } ///< 0 is the root
    [[nodiscard]] std::span<const BrickPlace> bricks() const noexcept { return bricks_; }
    /// Broad triangles that touch a brick, ascending.
    [[nodiscard]] std::vector<uint32_t> broad_of(const BrickPlace& brick) const;

private:
    void note_small_triangles(std::span<TopReach> of_surfaces);
    void find_masks(TopCell& cell);
    void note_broad_triangles(const TopCell& cell, std::span<TopReach> of_surfaces) const;
    void make_children(size_t parent);

    const Grid& grid_;
    const PlotTriangles& triangles_;
    TopReach also_; ///< with the cells of small triangles
    std::vector<TopCell> cells_;
    std::vector<BrickPlace> bricks_;
};

} // namespace cl::gi
