#pragma once

#include "servers/gi/vec3x4.h"

#include <glm/vec3.hpp>

namespace cl::gi {

/// A triangle's two edges from v0 and their products: what the point nearest to another one and its
/// barycentric coordinates are made of.
struct TriangleEdges {
    explicit TriangleEdges(const glm::vec3 (&v)[3]) noexcept;

    glm::vec3 v0;
    glm::vec3 e0, e1;  ///< to v1 and v2
    float a, b, c;     ///< e0 . e0, e0 . e1, e1 . e1
    float determinant; ///< a c - b^2; 0 for a degenerate triangle
};

/// As std::clamp does, NaN included.
inline float4 clamped_to_1(float4 v) noexcept {
    return select(v < float4{}, float4{}, select(v > splat(1.0f), splat(1.0f), v));
}

/// The points of a triangle nearest to p. Where v[1] == v[2] they may be NaN, and their consumer takes vertex
/// 0 then: cells at the pole of a sphere, whose last triangles are such, are Godot's only so. Source: Eberly,
/// "Distance Between Point and Triangle in 3D" (geometrictools.com), regions 0 to 6.
[[nodiscard]] inline Vec3x4 closest_points_of_triangle(const TriangleEdges& edges, const Vec3x4& p) noexcept {
    const Vec3x4 v0 = splat(edges.v0), e0 = splat(edges.e0), e1 = splat(edges.e1);
    const float a = edges.a, b = edges.b, c = edges.c;
    const Vec3x4 to_p = v0 - p;
    const float4 d = dot(e0, to_p);
    const float4 e = dot(e1, to_p);
    float4 s = b * e - c * d;
    float4 t = b * d - a * e;
    const int4 near_side = s + t < splat(edges.determinant);
    const int4 s_below = s < float4{}, t_below = t < float4{};
    const int4 inside = near_side & ~s_below & ~t_below; // region 0
    const float inverse = 1.0f / edges.determinant;
    s = select(inside, s * inverse, s);
    t = select(inside, t * inverse, t);
    if (lane_bits(inside) != 15u) {
        const float4 along_e0 = a > 0.0f ? clamped_to_1(-d / a) : float4{};
        const float4 along_e1 = c > 0.0f ? clamped_to_1(-e / c) : float4{};
        const int4 region_2 = ~near_side & s_below, region_6 = ~near_side & ~s_below & t_below;
        // A far edge without length divides by zero, and rounding noise in the numerator picks one of its
        // ends, or NaN.
        const float4 from_e0 = (c + e) - (b + d), from_e1 = (a + d) - (b + e);
        const float4 along_far = clamped_to_1(
            select(region_2, from_e0, select(region_6, from_e1, c + e - b - d)) / (a - 2.0f * b + c));
        const int4 on_far_edge =
            ~near_side & select(region_2, c + e > b + d, select(region_6, a + d > b + e, int4{} == int4{}));
        const int4 on_e0 =
            ~on_far_edge & ~inside &
            select(near_side, (t_below & ~s_below) | (s_below & t_below & (d < float4{})), region_6);
        const int4 on_e1 = ~on_far_edge & ~inside & ~on_e0;
        s = select(on_e0, along_e0, select(on_e1, float4{}, s));
        t = select(on_e0, float4{}, select(on_e1, along_e1, t));
        s = select(on_far_edge, select(region_6, 1.0f - along_far, along_far), s);
        t = select(on_far_edge, select(region_6, along_far, 1.0f - along_far), t);
    }
    return v0 + e0 * s + e1 * t;
}

} // namespace cl::gi
