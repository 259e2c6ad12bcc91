#pragma once

#include "servers/gi/relight.h"

#include <cstddef>

namespace cl::gi {

// A mip's texels in bricks: cubes of 8 x 8 x 8, fewer where the mip is smaller. A brick's texels are the
// cells below one cell of the octree, so they stand in a row in the layout; what changes is found, spread,
// encoded and uploaded by the brick.

/// Levels of the octree from a brick to its texels.
inline constexpr size_t kBrickLevels = 3;

/// Cells that stand in a row: [begin, end).
struct CellRange {
    size_t begin = 0, end = 0;
    [[nodiscard]] size_t size() const noexcept { return end - begin; }
};

/// Where the bricks of a mip are in the tree.
struct MipBricks {
    size_t texel_level = 0; ///< the cells of this level are the texels
    size_t brick_level = 0; ///< those of this one the bricks; the root where the tree ends sooner
    CellRange bricks;
};

/// @param mip  in [0, layout.levels): 0 are the leaves
[[nodiscard]] MipBricks bricks_of_mip(const CellLayout& layout, size_t mip) noexcept;

/// All cells `levels` levels below `cells`, which are of one level and above the leaves by as much.
[[nodiscard]] CellRange cells_below(const CellLayout& layout, CellRange cells, size_t levels) noexcept;

} // namespace cl::gi
