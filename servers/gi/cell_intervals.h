#pragma once

#include "servers/gi/float4.h"
#include "servers/gi/probe_data.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cl::gi {

/// A cell of the tree, reached from the root.
struct CellPlace {
    float4 position; ///< least corner, probe-local [m]: x, y, z, 0
    uint32_t number; ///< slots from the root, three bits a level
    int level;
};

/// Finds the smallest cell around a box without descending to it. Of each cell it knows, along each axis, an
/// interval: what lies between its ends is within the cell and all cells above, and is separated from the
/// cells beside them by their own axes. Each of these tests compares a rounded difference, which grows with
/// the coordinate, so what holds at the ends holds between them to the bit.
class CellIntervals {
public:
    explicit CellIntervals(const Grid& grid);

    /// The deepest cell inside the grid whose intervals hold all from `least` to `most` (x, y, z, 0), or the
    /// root: also of boxes outside it.
    [[nodiscard]] CellPlace cell_around(float4 least, float4 most) const noexcept;

private:
    struct Interval {
        float begin_m, end_m;
        float position_m; ///< the cell's least coordinate
        uint32_t number;  ///< a bit in three: this axis' bits of the slots from the root
    };
    using Axis = std::vector<Interval>; ///< from one side to the other
    static Axis halved(const Axis& parents, float child_size_m, int count);

    float4 root_;
    float4 cells_per_m_, last_; ///< of leaves; the last leaf along each axis
    std::vector<std::array<Axis, 3>> levels_;
};

} // namespace cl::gi
