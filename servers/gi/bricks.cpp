#include "servers/gi/bricks.h"

#include <algorithm>

namespace cl::gi {

MipBricks bricks_of_mip(const CellLayout& layout, size_t mip) noexcept {
    MipBricks bricks;
    bricks.texel_level = size_t(layout.levels) - 1 - mip;
    bricks.brick_level = bricks.texel_level - std::min(bricks.texel_level, kBrickLevels);
    bricks.bricks = {layout.level_begin[bricks.brick_level], layout.level_begin[bricks.brick_level + 1]};
    return bricks;
}

CellRange cells_below(const CellLayout& layout, CellRange cells, size_t levels) noexcept {
    for (; levels > 0; --levels) {
        cells = {layout.first_child[cells.begin], layout.first_child[cells.end]};
    }
    return cells;
}

} // namespace cl::gi
