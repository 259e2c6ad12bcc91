#pragma once

#include <glm/vec3.hpp>

#include <cmath>

namespace cl {

/// True for points and directions that rays may have: finite, and so small that their squares are. Embree
/// itself draws the line at 1.8e18 and stops the program beyond it.
[[nodiscard]] inline bool is_traceable(const glm::vec3& v) noexcept {
    constexpr float kMost = 1e18f;
    return std::abs(v.x) < kMost && std::abs(v.y) < kMost && std::abs(v.z) < kMost; // false for NaN
}

} // namespace cl
