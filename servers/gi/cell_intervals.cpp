#include "servers/gi/cell_intervals.h"

#include <algorithm>
#include <limits>

namespace cl::gi {

namespace {

/// A cell's border moved inwards until `holds` is true of it, by at most a quarter of the cell.
/// @param size_m  of the cell, negative to move to the left. @return NaN, between which and anything there is
/// nothing, if that is not enough.
template <typename Holds>
float moved_in(float border_m, float size_m, Holds holds) {
    constexpr float kLeast = 1e-6f, kMost = 0.25f; // of the cell
    float at_m = border_m;
    for (float step = kLeast; !holds(at_m); step *= 2.0f) {
        if (step > kMost) {
            return std::numeric_limits<float>::quiet_NaN();
        }
        at_m = border_m + step * size_m;
    }
    return at_m;
}

} // namespace

CellIntervals::CellIntervals(const Grid& grid) {
    const glm::vec3 root = grid.cubic_box.position;
    root_ = float4{root.x, root.y, root.z, 0.0f};
    constexpr float kAll = std::numeric_limits<float>::infinity();
    std::array<Axis, 3>& top = levels_.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
        top[size_t(axis)] = {{-kAll, kAll, root[axis], 0}};
    }
    const int leaf_level = grid.levels - 1;
    float size_m = grid.cubic_box.size.x;
    for (int level = 1; level <= leaf_level; ++level) {
        size_m *= 0.5f;
        const int leaves_per_cell = 1 << (leaf_level - level);
        std::array<Axis, 3> axes;
        for (int axis = 0; axis < 3; ++axis) {
            const int count = (grid.dims[axis] + leaves_per_cell - 1) / leaves_per_cell;
            axes[size_t(axis)] = halved(levels_.back()[size_t(axis)], size_m, count);
        }
        levels_.push_back(std::move(axes));
    }
    cells_per_m_ = splat(1.0f / size_m);
    last_ = float4{float(grid.dims.x - 1), float(grid.dims.y - 1), float(grid.dims.z - 1), 0.0f};
}

CellIntervals::Axis CellIntervals::halved(const Axis& parents, float size_m, int count) {
    const float half = size_m * 0.5f;
    Axis children;
    children.reserve(size_t(count));
    for (int i = 0; i < count; ++i) {
        const Interval& parent = parents[size_t(i / 2)];
        const bool is_upper = i % 2 != 0;
        const float lower_middle = parent.position_m + half, upper_middle = parent.position_m + size_m + half;
        const float begin = is_upper ? parent.position_m + size_m : parent.position_m;
        const float begin_in = moved_in(begin, size_m, [&](float x) {
            return is_upper ? x - upper_middle >= -half && x - lower_middle > half
                            : x - lower_middle >= -half;
        });
        const float end_in = moved_in(begin + size_m, -size_m, [&](float x) {
            return is_upper ? x - upper_middle <= half : x - lower_middle <= half && x - upper_middle < -half;
        });
        // A NaN as first argument is what std::max and std::min return.
        children.push_back({std::max(begin_in, parent.begin_m), std::min(end_in, parent.end_m), begin,
                            parent.number << 3 | uint32_t(is_upper)});
    }
    return children;
}

CellPlace CellIntervals::cell_around(float4 least, float4 most) const noexcept {
    const int4 leaf = to_int(lesser(greater((least - root_) * cells_per_m_, float4{}), last_));
    int shift = 0;
    for (size_t level = levels_.size() - 1; level > 0; --level, ++shift) {
        const std::array<Axis, 3>& axes = levels_[level];
        const Interval& x = axes[0][size_t(leaf[0] >> shift)];
        const Interval& y = axes[1][size_t(leaf[1] >> shift)];
        const Interval& z = axes[2][size_t(leaf[2] >> shift)];
        const float4 begin{x.begin_m, y.begin_m, z.begin_m, 0.0f};
        const float4 end{x.end_m, y.end_m, z.end_m, 0.0f};
        if (lane_bits((least >= begin) & (most <= end)) == 15u) {
            return {float4{x.position_m, y.position_m, z.position_m, 0.0f},
                    x.number | y.number << 1 | z.number << 2, int(level)};
        }
    }
    return {root_, 0, 0};
}

} // namespace cl::gi
