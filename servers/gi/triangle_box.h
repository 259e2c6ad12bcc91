#pragma once

#include "servers/gi/float4.h"

#include <glm/vec3.hpp>

namespace cl::gi {

/// Boxes that are tested together: one (F = float) or four (F = float4, a lane each).
template <typename F>
struct Boxes {
    F center[3];
    F half[3];
};

/// A triangle moved so that the boxes' centres are the origin, and its edges.
template <typename F>
struct CenteredTriangle {
    F v[3][3]; ///< [vertex][axis]
    F e[3][3]; ///< v1 - v0, v2 - v1, v0 - v2
};

template <typename F>
inline CenteredTriangle<F> centered(const Boxes<F>& boxes, const glm::vec3 (&vertices)[3]) noexcept {
    CenteredTriangle<F> t;
    for (int axis = 0; axis < 3; ++axis) {
        for (int k = 0; k < 3; ++k) {
            t.v[k][axis] = vertices[k][axis] - boxes.center[axis];
        }
        t.e[0][axis] = t.v[1][axis] - t.v[0][axis];
        t.e[1][axis] = t.v[2][axis] - t.v[1][axis];
        t.e[2][axis] = t.v[0][axis] - t.v[2][axis];
    }
    return t;
}

/// True where one axis of the boxes separates.
template <typename F>
inline auto separated_by_box_axis(int axis, const Boxes<F>& boxes, const glm::vec3 (&vertices)[3]) noexcept {
    // Subtracting the centre keeps the order of numbers: the least is found before, not of three differences.
    const float v0 = vertices[0][axis], v1 = vertices[1][axis], v2 = vertices[2][axis];
    const F lo = lesser(lesser(v0, v1), v2) - boxes.center[axis];
    const F hi = greater(greater(v0, v1), v2) - boxes.center[axis];
    return either(lo > boxes.half[axis], hi < -boxes.half[axis]);
}

/// True where a box axis separates (rule 2 of spec gi-bake section 4.1).
template <typename F>
inline auto separated_by_box_axis(const Boxes<F>& boxes, const glm::vec3 (&vertices)[3]) noexcept {
    return either(
        either(separated_by_box_axis(0, boxes, vertices), separated_by_box_axis(1, boxes, vertices)),
        separated_by_box_axis(2, boxes, vertices));
}

/// True where the cross product of an edge and a coordinate axis separates (rule 1). All three axes are one
/// formula with the coordinates rotated: only signs differ from the specification's, and the interval test is
/// symmetric in them. Edge and axis are template arguments so that every index below is a constant.
template <int edge, int k, typename F>
inline auto separated_by_edge_axis(const Boxes<F>& boxes, const CenteredTriangle<F>& t) noexcept {
    // Which two vertices span the projection. Any pair but the edge's own ends would do in exact arithmetic;
    // which one it is decides the last bit.
    constexpr int kPair[3][3][2] = {
        {{0, 2}, {0, 2}, {0, 1}}, // x: edges 0, 1, 2
        {{0, 2}, {0, 2}, {0, 1}}, // y
        {{1, 2}, {0, 1}, {1, 2}}, // z
    };
    constexpr int i = (k + 1) % 3;
    constexpr int j = (k + 2) % 3;
    const F* const e = t.e[edge];
    const F* const a = t.v[kPair[k][edge][0]];
    const F* const b = t.v[kPair[k][edge][1]];
    const F pa = e[j] * a[i] - e[i] * a[j];
    const F pb = e[j] * b[i] - e[i] * b[j];
    const F radius = magnitude(e[j]) * boxes.half[i] + magnitude(e[i]) * boxes.half[j];
    return either(lesser(pa, pb) > radius, greater(pa, pb) < -radius);
}

/// True where the cross product of a coordinate axis and one of the three edges separates: boxes that the
/// triangle misses, seen along that axis.
template <int k, typename F>
inline auto separated_by_edges_along(const Boxes<F>& boxes, const CenteredTriangle<F>& t) noexcept {
    return either(either(separated_by_edge_axis<0, k>(boxes, t), separated_by_edge_axis<1, k>(boxes, t)),
                  separated_by_edge_axis<2, k>(boxes, t));
}

/// True where the triangle's plane misses the box (rule 3).
template <typename F>
inline auto separated_by_plane(const Boxes<F>& boxes, const CenteredTriangle<F>& t) noexcept {
    const F* const e0 = t.e[0];
    const F* const e1 = t.e[1];
    const F n[3] = {e0[1] * e1[2] - e0[2] * e1[1], e0[2] * e1[0] - e0[0] * e1[2],
                    e0[0] * e1[1] - e0[1] * e1[0]};
    const F d = -(n[0] * t.v[0][0] + n[1] * t.v[0][1] + n[2] * t.v[0][2]);
    F near_corner[3];
    F far_corner[3];
    for (int a = 0; a < 3; ++a) {
        const auto faces_up = n[a] > F{};
        near_corner[a] = select(faces_up, -boxes.half[a], boxes.half[a]);
        far_corner[a] = select(faces_up, boxes.half[a], -boxes.half[a]);
    }
    const F near_distance = n[0] * near_corner[0] + n[1] * near_corner[1] + n[2] * near_corner[2] + d;
    const F far_distance = n[0] * far_corner[0] + n[1] * far_corner[1] + n[2] * far_corner[2] + d;
    return either(near_distance > F{}, far_distance < F{});
}

/// True (or -1) where one of rules 1 and 3 separates: all that the box's own axes do not tell.
template <typename F>
inline auto separated_by_edges_or_plane(const Boxes<F>& boxes, const glm::vec3 (&vertices)[3]) noexcept {
    const CenteredTriangle<F> t = centered(boxes, vertices);
    const auto by_edges =
        either(either(separated_by_edges_along<0>(boxes, t), separated_by_edges_along<1>(boxes, t)),
               separated_by_edges_along<2>(boxes, t));
    return either(by_edges, separated_by_plane(boxes, t));
}

/// True (or -1) where the triangle does not touch the box: the separating-axis test of spec gi-bake
/// section 4.1.
template <typename F>
inline auto separated(const Boxes<F>& boxes, const glm::vec3 (&vertices)[3]) noexcept {
    return either(separated_by_box_axis(boxes, vertices), separated_by_edges_or_plane(boxes, vertices));
}

/// True where all vertices lie in the box. No axis separates such a box from the triangle, which holds for
/// the rounded numbers of separated(), too: each product and sum of a vertex's projection is at most that of
/// the box's radius, before rounding and hence after it.
template <typename F>
inline auto lies_within(const Boxes<F>& boxes, const glm::vec3 (&vertices)[3]) noexcept {
    const auto along = [&](int axis) {
        const float v0 = vertices[0][axis], v1 = vertices[1][axis], v2 = vertices[2][axis];
        const F lo = lesser(lesser(v0, v1), v2) - boxes.center[axis];
        const F hi = greater(greater(v0, v1), v2) - boxes.center[axis];
        return both(lo >= -boxes.half[axis], hi <= boxes.half[axis]);
    };
    return both(both(along(0), along(1)), along(2));
}

/// Bit i is set where box i of four touches the triangle.
inline uint32_t overlapping_boxes(const Boxes<float4>& boxes, const glm::vec3 (&vertices)[3]) noexcept {
    return ~lane_bits(separated(boxes, vertices)) & 15u;
}

} // namespace cl::gi
