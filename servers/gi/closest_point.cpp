#include "servers/gi/closest_point.h"

#include <algorithm>

namespace cl::gi {

namespace {

/// x, y, z summed in that order.
float dot(const glm::vec3& a, const glm::vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

} // namespace

glm::vec3 closest_point_of_triangle(const glm::vec3 (&v)[3], const glm::vec3& p) noexcept {
    const glm::vec3 e0 = v[1] - v[0];
    const glm::vec3 e1 = v[2] - v[0];
    const glm::vec3 to_p = v[0] - p;
    const float a = dot(e0, e0);
    const float b = dot(e0, e1);
    const float c = dot(e1, e1);
    const float d = dot(e0, to_p);
    const float e = dot(e1, to_p);
    const float determinant = a * c - b * b;
    float s = b * e - c * d;
    float t = b * d - a * e;
    const auto along_e0 = [&] { return a > 0.0f ? std::clamp(-d / a, 0.0f, 1.0f) : 0.0f; };
    const auto along_e1 = [&] { return c > 0.0f ? std::clamp(-e / c, 0.0f, 1.0f) : 0.0f; };
    // A far edge without length divides by zero, and rounding noise in the numerator picks one of its ends,
    // or NaN.
    const auto along_far_edge = [&](float numerator) {
        return std::clamp(numerator / (a - 2.0f * b + c), 0.0f, 1.0f);
    };
    if (s + t < determinant) {
        if (s < 0.0f && t < 0.0f && d < 0.0f) { // region 4, nearer to e0
            s = along_e0();
            t = 0.0f;
        } else if (s < 0.0f) { // regions 3 and 4
            s = 0.0f;
            t = along_e1();
        } else if (t < 0.0f) { // region 5
            s = along_e0();
            t = 0.0f;
        } else { // region 0, inside
            const float inverse = 1.0f / determinant;
            s *= inverse;
            t *= inverse;
        }
    } else if (s < 0.0f) { // region 2
        const bool on_far_edge = c + e > b + d;
        s = on_far_edge ? along_far_edge((c + e) - (b + d)) : 0.0f;
        t = on_far_edge ? 1.0f - s : along_e1();
    } else if (t < 0.0f) { // region 6
        const bool on_far_edge = a + d > b + e;
        t = on_far_edge ? along_far_edge((a + d) - (b + e)) : 0.0f;
        s = on_far_edge ? 1.0f - t : along_e0();
    } else { // region 1
        s = along_far_edge(c + e - b - d);
        t = 1.0f - s;
    }
    return v[0] + s * e0 + t * e1;
}

} // namespace cl::gi
