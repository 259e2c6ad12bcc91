#include "servers/gi/small_triangles.h"

#include "servers/gi/octree_builder.h"
#include "servers/gi/triangle_box.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>

namespace cl::gi {

namespace {

constexpr float kMostCells = 2.0f; ///< longest side of a small triangle
constexpr uint32_t kXYZ = 7;

float4 with_xyz(const glm::vec3& v) {
    return float4{v.x, v.y, v.z, 0.0f};
}

/// Bits of the slots that lie in the lower or upper halves of a cell along the axes whose bits are set.
uint32_t slots_in(uint32_t lower, uint32_t upper) {
    constexpr uint32_t kUpperSlots[3] = {0xAA, 0xCC, 0xF0};
    uint32_t slots = 0xFF;
    for (int axis = 0; axis < 3; ++axis) {
        const uint32_t from_lower = (lower >> axis) & 1u ? ~kUpperSlots[axis] : 0u;
        const uint32_t from_upper = (upper >> axis) & 1u ? kUpperSlots[axis] : 0u;
        slots &= from_lower | from_upper;
    }
    return slots;
}

/// The two halves of a cell along each axis: lanes x, y, z.
struct Halves {
    Halves(float4 cell_position, float cell_size_m) : half_m(cell_size_m * 0.5f * 0.5f) {
        position[0] = cell_position;
        position[1] = cell_position + cell_size_m * 0.5f;
        center[0] = position[0] + half_m;
        center[1] = position[1] + half_m;
    }
    /// Slots that their own axes do not separate from what lies between two corners.
    [[nodiscard]] uint32_t slots_met(float4 least, float4 most) const {
        const auto met = [&](float4 middle) {
            return ~lane_bits(either(least - middle > splat(half_m), most - middle < splat(-half_m)));
        };
        return slots_in(met(center[0]), met(center[1]));
    }
    /// Slots well inside of which one of the corners lies.
    [[nodiscard]] uint32_t slots_around(const float4 (&corners)[3]) const {
        constexpr float kWellInside = 1.0f - 1.0f / 512.0f;
        const float4 reach = splat(half_m * kWellInside);
        uint32_t slots = 0;
        for (const float4& corner : corners) {
            const uint32_t lower = lane_bits(magnitude(corner - center[0]) <= reach) & kXYZ;
            const uint32_t upper = lane_bits(magnitude(corner - center[1]) <= reach) & kXYZ;
            slots |= (lower | upper) == kXYZ ? 1u << upper : 0u;
        }
        return slots;
    }
    [[nodiscard]] float4 position_of(uint32_t slot) const {
        return float4{position[slot & 1u][0], position[(slot >> 1) & 1u][1], position[slot >> 2][2], 0.0f};
    }

    float4 position[2], center[2];
    float half_m; ///< half the edge of a child
};

/// Whether rounding may turn a triangle's plane away from a corner of it by more than a thousandth of its
/// size.
bool is_sliver(const glm::vec3 (&v)[3]) {
    constexpr float kLeastSine = 0.02f, kLeast_m2 = 1e-24f; // below, products would be denormal
    const glm::vec3 e0 = v[1] - v[0], e1 = v[2] - v[1], e2 = v[0] - v[2];
    const float longest2 = std::max(glm::dot(e0, e0), std::max(glm::dot(e1, e1), glm::dot(e2, e2)));
    const glm::vec3 n = glm::cross(e0, e1);
    const float least = kLeastSine * longest2;
    return !(longest2 > kLeast_m2 && glm::dot(n, n) > least * least);
}

/// Those of `slots` that touch the triangle, by the full test, four at a time.
uint32_t touched_slots(const Halves& halves, uint32_t slots, const glm::vec3 (&vertices)[3]) {
    uint32_t touched = 0;
    while (slots != 0u) {
        Boxes<float4> boxes;
        int of_lane[4] = {};
        int count = 0;
        for (; slots != 0u && count < 4; ++count, slots &= slots - 1) {
            of_lane[count] = std::countr_zero(slots);
        }
        for (int axis = 0; axis < 3; ++axis) {
            boxes.half[axis] = splat(halves.half_m);
            for (int i = 0; i < 4; ++i) {
                boxes.center[axis][i] = halves.center[(of_lane[i] >> axis) & 1][axis];
            }
        }
        const uint32_t overlap = ~lane_bits(separated_by_edges_or_plane(boxes, vertices));
        for (int i = 0; i < count; ++i) {
            touched |= ((overlap >> i) & 1u) << of_lane[i];
        }
    }
    return touched;
}

} // namespace

SmallTriangles::SmallTriangles(const Grid& grid) : most_m_(kMostCells * grid.cell_size_m), intervals_(grid) {
    // Axes have powers of two of cells, so which children lie inside is the same for all cells of a level
    // that do.
    CellBox cell = root_cell(grid);
    for (; cell.level < grid.levels - 1; cell = child_cell(grid, cell, 0)) {
        levels_.push_back({cell.size_m, octants_of(grid, cell).inside});
    }
}

bool SmallTriangles::find_leaves(const glm::vec3 (&v)[3], Leaves& leaves) const noexcept {
    leaves.count_ = 0;
    Triangle t{v, {with_xyz(v[0]), with_xyz(v[1]), with_xyz(v[2])}, {}, {}, true};
    t.least = lesser(lesser(t.corners[0], t.corners[1]), t.corners[2]);
    t.most = greater(greater(t.corners[0], t.corners[1]), t.corners[2]);
    if (lane_bits(t.most - t.least > splat(most_m_)) != 0u) {
        return false;
    }
    const CellPlace around = intervals_.cell_around(t.least, t.most);
    if (around.level == int(levels_.size())) {
        leaves.leaves_[leaves.count_++] = around.number;
        return true;
    }
    t.is_sliver = is_sliver(v);
    return descend(t, around, leaves);
}

bool SmallTriangles::descend(const Triangle& t, const CellPlace& place, Leaves& leaves) const noexcept {
    if (place.level == int(levels_.size())) {
        if (leaves.count_ == Leaves::kMost) {
            return false;
        }
        leaves.leaves_[leaves.count_++] = place.number;
        return true;
    }
    const Level& level = levels_[size_t(place.level)];
    const Halves halves(place.position, level.size_m);
    const uint32_t met = halves.slots_met(t.least, t.most) & level.inside;
    // The full test finds no axis between a box and a triangle of which a corner lies well inside: the room
    // to the box's sides is a hundred times what float32 may err by with boxes and triangles of such sizes.
    const uint32_t sure = t.is_sliver ? 0u : met & halves.slots_around(t.corners);
    const uint32_t touched = sure | touched_slots(halves, met & ~sure, t.vertices);
    for (uint32_t left = touched; left != 0u; left &= left - 1) {
        const uint32_t slot = uint32_t(std::countr_zero(left));
        if (!descend(t, {halves.position_of(slot), place.number * 8 + slot, place.level + 1}, leaves)) {
            return false;
        }
    }
    return touched != 0u;
}

} // namespace cl::gi
