#include "servers/gi/light_march.h"

#include "servers/gi/float4.h"

#include <algorithm>
#include <cmath>

namespace cl::gi {

namespace {

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

uint32_t reaches_each(const LeafBitmap& leaves, const std::array<AimedMarch, kMarchLanes>& marches) noexcept {
    // The fourth lane is the distance that is left.
    std::array<float4, kMarchLanes> at, step;
    for (size_t i = 0; i < kMarchLanes; ++i) {
        const March& m = marches[i].march;
        const glm::vec3 stride = m.direction * m.step;
        at[i] = float4{m.from.x, m.from.y, m.from.z, m.distance};
        step[i] = float4{stride.x, stride.y, stride.z, -m.step};
    }
    std::array<uint32_t, kMarchLanes> free{}; ///< steps before the next look
    uint32_t walking = (1u << kMarchLanes) - 1, reached = 0;
    for (;;) {
        uint32_t leap = UINT32_MAX;
        for (size_t i = 0; i < kMarchLanes; ++i) {
            if ((walking >> i & 1u) != 0 && free[i] == 0) {
                const int4 cell = floored(at[i]);
                const LeafBitmap::Found found = leaves.look(cell[0], cell[1], cell[2]);
                free[i] = found.free_steps + 1;
                if (found.leaf || !(at[i][3] > step[i][3])) {
                    const bool is_target = cell[0] == marches[i].target.x && cell[1] == marches[i].target.y &&
                                           cell[2] == marches[i].target.z;
                    reached |= uint32_t(is_target && at[i][3] > step[i][3]) << i;
                    walking &= ~(1u << i);
                    free[i] = UINT32_MAX;
                }
            }
            leap = std::min(leap, free[i]);
        }
        if (walking == 0) {
            return reached;
        }
        for (uint32_t& steps : free) {
            steps -= leap;
        }
        // Free steps are still taken one by one: the sum of their roundings decides where the ray arrives.
        // Those beyond the end meet nothing either.
        float4 a = at[0], b = at[1], c = at[2], d = at[3];
        for (; leap > 0; --leap) {
            a += step[0];
            b += step[1];
            c += step[2];
            d += step[3];
        }
        at = {a, b, c, d};
    }
}

bool reaches(const LeafBitmap& leaves, const AimedMarch& aimed) noexcept {
    return (reaches_each(leaves, {aimed, aimed, aimed, aimed}) & 1u) != 0;
}

} // namespace cl::gi
