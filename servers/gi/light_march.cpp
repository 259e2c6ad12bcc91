#include "servers/gi/light_march.h"

#include <cmath>

namespace cl::gi {

namespace {

float4 lanes(const glm::vec3& v) {
    return float4{v.x, v.y, v.z, 0.0f};
}

/// Rounds toward minus infinity; |v| < 2^31.
int4 floored(float4 v) {
    const int4 truncated = __builtin_convertvector(v, int4);
    return truncated + (__builtin_convertvector(truncated, float4) > v); // -1 where it truncated up
}

} // namespace

float advance_of(const glm::vec3& direction) noexcept {
    const glm::vec3 a(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
    if (a.x >= a.y && a.x >= a.z) {
        return 1.0f / a.x;
    }
    if (a.y > a.x && a.y >= a.z) {
        return 1.0f / a.y;
    }
    return 1.0f / (a.z > a.x && a.z > a.y ? a.z : a.x);
}

float remainder_of(float a, float b) noexcept {
    // Products and differences of floats with a quotient below 2^24 are exact in double.
    const double whole = double(int64_t(double(a) / double(b)));
    double rest = double(a) - whole * double(b);
    rest += rest < 0.0 ? double(b) : 0.0;
    rest -= rest >= double(b) ? double(b) : 0.0;
    return float(rest);
}

bool reaches(const LeafBitmap& leaves, const March& march, const glm::ivec3& target) noexcept {
    float4 at = lanes(march.from);
    const float4 step = lanes(march.direction * march.step);
    float distance = march.distance;
    while (distance > -march.step) {
        const int4 cell = floored(at);
        const LeafBitmap::Found found = leaves.look(cell[0], cell[1], cell[2]);
        if (found.leaf) {
            return cell[0] == target.x && cell[1] == target.y && cell[2] == target.z;
        }
        // Free steps are still taken one by one: the sum of their roundings decides where the ray arrives.
        for (uint32_t i = 0; i <= found.free_steps && distance > -march.step; ++i) {
            at += step;
            distance -= march.step;
        }
    }
    return false;
}

} // namespace cl::gi
