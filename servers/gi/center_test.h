#pragma once

#include "servers/gi/triangle_box.h"

#include <glm/vec3.hpp>

namespace cl::gi {

/// A cheap test that settles most boxes of a large triangle. Where a triangle, seen along the main axis of
/// its normal, covers the middle of a box and its plane passes there well inside the box, no axis separates
/// them; the room to the box's sides is thousands of times what float32 may err by, so that the full test of
/// triangle_box.h would give the same answer, to the bit.
struct CenterTest {
    int axis = 0;               ///< the normal's main axis
    float edge[3][3] = {};      ///< a, b, c: a * u + b * w + c >= 0 on the inside of each edge [m]
    float plane[3] = {};        ///< a, b, c: the plane's coordinate along `axis` at u, w
    float least_half_m = 1e30f; ///< smaller boxes are not settled: rounding might matter
    /// All corners have one coordinate along `axis`, to the bit. The edges' and the plane's tests then
    /// compare that coordinate times one factor with the box's half times the same: rounding keeps their
    /// order, so the test of the box's own axis, which is made in full, decides alone.
    bool is_flat = false;
};

/// Never settles anything (least_half_m stays) for slivers and degenerate triangles.
[[nodiscard]] CenterTest make_center_test(const glm::vec3 (&vertices)[3], int axis) noexcept;

/// True (-1) where a box that its own axes do not separate from the triangle surely touches it.
template <typename F>
inline auto surely_touches(const CenterTest& test, const Boxes<F>& boxes) noexcept {
    const F u = boxes.center[(test.axis + 1) % 3], w = boxes.center[(test.axis + 2) % 3];
    const auto inside = [&](int k) {
        return u * test.edge[k][0] + w * test.edge[k][1] + test.edge[k][2] >= F{};
    };
    const auto covered = inside(0) & inside(1) & inside(2);
    if (test.is_flat) {
        return covered;
    }
    constexpr float kWellInside = 0.9f;
    const F at = u * test.plane[0] + w * test.plane[1] + test.plane[2];
    return covered & (magnitude(at - boxes.center[test.axis]) <= boxes.half[test.axis] * kWellInside);
}

/// Bit i is set where box i of four touches the triangle: the full test, where the cheap ones leave it open.
/// @param least_half_m  the smallest half edge of the boxes
inline uint32_t overlapping_boxes(const Boxes<float4>& boxes, const glm::vec3 (&vertices)[3],
                                  const CenterTest& test, float least_half_m) noexcept {
    const uint32_t apart = lane_bits(separated_by_box_axis(boxes, vertices));
    if (apart == 15u) {
        return 0;
    }
    const bool may_settle = least_half_m >= test.least_half_m;
    if (may_settle && (apart | lane_bits(surely_touches(test, boxes))) == 15u) {
        return ~apart & 15u;
    }
    return overlapping_boxes(boxes, vertices);
}

} // namespace cl::gi
