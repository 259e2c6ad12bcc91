#pragma once

#include "servers/gi/center_test.h"
#include "servers/gi/plot_triangle.h"
#include "servers/gi/triangle_box.h"
#include "servers/gi/vec3x4.h"

#include <glm/vec3.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cl::gi {

/// Samples of a leaf along each of the two axes across a triangle's main one.
inline constexpr int kColumns = 4;

/// A leaf's box: a cube.
struct LeafBox {
    glm::vec3 position{0.0f}; ///< least corner, probe-local [m]
    float size_m = 0.0f;
};

/// Up to four columns, a lane each.
class ColumnGroup {
public:
    /// Takes the lowest four out of `columns`, of which there is one at least; lanes beyond repeat the last.
    explicit ColumnGroup(uint32_t& columns) noexcept {
        int at[4];
        for (int& column : at) {
            column = columns != 0u ? std::countr_zero(columns) : at[count_ - 1];
            count_ += columns != 0u ? 1 : 0;
            columns &= columns - 1;
        }
        columns_ = int4{at[0], at[1], at[2], at[3]};
    }
    [[nodiscard]] int count() const noexcept { return count_; }
    [[nodiscard]] float4 i() const noexcept { return to_float(columns_ >> 2); }
    [[nodiscard]] float4 j() const noexcept { return to_float(columns_ & 3); }

private:
    int4 columns_{};
    int count_ = 0;
};

/// The columns of a leaf along a triangle's main axis (spec gi-bake section 5, steps 1 to 3). A column is a
/// bit, (4 i + j), of steps i along the next axis and j along the one after. The axis is a template argument
/// so that every index is a constant.
template <int axis>
class LeafColumns {
public:
    LeafColumns(const LeafBox& leaf, const PlotTriangle& t) noexcept
        : leaf_(leaf), t_(t), step_m_(leaf.size_m / float(kColumns)) {}

    /// The columns that the triangle touches.
    [[nodiscard]] uint32_t touched(const CenterTest& test) const noexcept {
        if (all_are_sure(test)) {
            return 0xFFFFu;
        }
        // What looks at only one of u and w, the boxes along the diagonal tell of all rows or of all columns
        // in a row.
        const float4 steps{0.0f, 1.0f, 2.0f, 3.0f};
        const Boxes<float4> diagonal = boxes_at(steps, steps);
        if (lane_bits(separated_by_box_axis(axis, diagonal, t_.v)) != 0u) {
            return 0;
        }
        const CenteredTriangle<float4> t = centered(diagonal, t_.v);
        const uint32_t rows = ~lane_bits(
            either(separated_by_box_axis(u, diagonal, t_.v), separated_by_edges_along<w>(diagonal, t)));
        const uint32_t in_row = ~lane_bits(
            either(separated_by_box_axis(w, diagonal, t_.v), separated_by_edges_along<u>(diagonal, t)));
        if ((in_row & 15u) == 0u) {
            return 0;
        }
        return (rows & 1u ? in_row & touched_in_row<0>(diagonal, t) : 0u) |
               (rows & 2u ? (in_row & touched_in_row<1>(diagonal, t)) << 4 : 0u) |
               (rows & 4u ? (in_row & touched_in_row<2>(diagonal, t)) << 8 : 0u) |
               (rows & 8u ? (in_row & touched_in_row<3>(diagonal, t)) << 12 : 0u);
    }

    /// Where the axes of four columns meet the triangle's plane, or come nearest to it.
    [[nodiscard]] Vec3x4 points_on_plane(const ColumnGroup& group) const noexcept {
        Vec3x4 a; // spans one cell below the leaf to its top
        a[u] = leaf_.position[u] + group.i() * step_m_ + step_m_ * 0.5f;
        a[w] = leaf_.position[w] + group.j() * step_m_ + step_m_ * 0.5f;
        a[axis] = splat(leaf_.position[axis] - leaf_.size_m);
        Vec3x4 b = a;
        b[axis] = a[axis] + 2.0f * leaf_.size_m;
        const Vec3x4 normal = splat(t_.plane_normal);
        if (dot(normal, a - b)[0] < 0.0f) { // the same for all columns
            std::swap(a, b);
        }
        constexpr float kEpsilon = 1e-5f;
        const Vec3x4 along = a - b;
        const float4 denominator = dot(normal, along);
        const float4 distance_a = dot(normal, a) - t_.plane_d;
        int4 meets{};
        Vec3x4 points = a;
        if (std::abs(denominator[0]) >= kEpsilon) {
            const float4 s = distance_a / denominator;
            meets = (s >= splat(-kEpsilon)) & (s <= splat(1.0f + kEpsilon));
            points = a - along * s;
        }
        if (lane_bits(meets) != 15u) {
            const float4 distance_b = dot(normal, b) - t_.plane_d;
            const int4 a_is_nearer = magnitude(distance_a) < magnitude(distance_b);
            points =
                select(meets, points, select(a_is_nearer, a - normal * distance_a, b - normal * distance_b));
        }
        return points;
    }

private:
    static constexpr int u = (axis + 1) % 3, w = (axis + 2) % 3;

    /// True if the cheap test settles the four columns at the corners: what it asks of their middles then
    /// holds between them.
    [[nodiscard]] bool all_are_sure(const CenterTest& test) const {
        if (0.5f * step_m_ < test.least_half_m) {
            return false;
        }
        const Boxes<float4> corners =
            boxes_at(float4{0.0f, 0.0f, 3.0f, 3.0f}, float4{0.0f, 3.0f, 0.0f, 3.0f});
        return lane_bits(surely_touches(test, corners)) == 15u &&
               lane_bits(separated_by_box_axis(corners, t_.v)) == 0u;
    }

    /// Columns of a row that neither what looks along the axis nor the plane separates.
    template <int row>
    [[nodiscard]] static uint32_t touched_in_row(Boxes<float4> boxes, CenteredTriangle<float4> t) {
        boxes.half[u] = splat(boxes.half[u][row]);
        for (int k = 0; k < 3; ++k) {
            t.v[k][u] = splat(t.v[k][u][row]);
            t.e[k][u] = splat(t.e[k][u][row]);
        }
        const uint32_t covered = ~lane_bits(separated_by_edges_along<axis>(boxes, t)) & 15u;
        return covered == 0u ? 0u : covered & ~lane_bits(separated_by_plane(boxes, t));
    }

    [[nodiscard]] Boxes<float4> boxes_at(float4 i, float4 j) const {
        Boxes<float4> boxes;
        place(boxes, axis, splat(leaf_.position[axis]), leaf_.size_m);
        place(boxes, u, leaf_.position[u] + i * step_m_, step_m_);
        place(boxes, w, leaf_.position[w] + j * step_m_, step_m_);
        return boxes;
    }
    static void place(Boxes<float4>& boxes, int along, float4 from, float size) {
        const float4 to = from + size;
        boxes.half[along] = (to - from) * 0.5f;
        boxes.center[along] = from + boxes.half[along];
    }

    const LeafBox& leaf_;
    const PlotTriangle& t_;
    float step_m_;
};

} // namespace cl::gi
