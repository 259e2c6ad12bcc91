#pragma once

#include "servers/gi/float4.h"

#include <glm/vec3.hpp>

namespace cl::gi {

/// Four vectors or points, a lane each.
struct Vec3x4 {
    float4 axis[3];

    float4& operator[](int i) noexcept { return axis[i]; }
    const float4& operator[](int i) const noexcept { return axis[i]; }
};

inline Vec3x4 splat(const glm::vec3& v) noexcept {
    return {{splat(v.x), splat(v.y), splat(v.z)}};
}
inline glm::vec3 lane(const Vec3x4& v, int i) noexcept {
    return {v[0][i], v[1][i], v[2][i]};
}
inline Vec3x4 operator+(const Vec3x4& a, const Vec3x4& b) noexcept {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
inline Vec3x4 operator-(const Vec3x4& a, const Vec3x4& b) noexcept {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
inline Vec3x4 operator*(const Vec3x4& a, float4 b) noexcept {
    return {{a[0] * b, a[1] * b, a[2] * b}};
}
/// x, y, z summed in that order.
inline float4 dot(const Vec3x4& a, const Vec3x4& b) noexcept {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3x4 select(int4 mask, const Vec3x4& a, const Vec3x4& b) noexcept {
    return {{select(mask, a[0], b[0]), select(mask, a[1], b[1]), select(mask, a[2], b[2])}};
}

} // namespace cl::gi
