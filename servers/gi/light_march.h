#pragma once

#include "servers/gi/leaf_bitmap.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace cl::gi {

/// A straight walk through the cells of a grid toward a leaf, one voxel of the dominant axis a step (spec
/// gi-update section 5.1). All in cells of the grid.
struct March {
    glm::vec3 from{0.0f};
    glm::vec3 direction{0.0f}; ///< unit length, toward the leaf
    float distance = 0.0f;
    float step = 0.0f; ///< advance_of(direction)
};

/// Length of a step that moves by one voxel along the dominant axis: 1 / its magnitude.
[[nodiscard]] float advance_of(const glm::vec3& direction) noexcept;

/// Remainder of a / b for 0 <= a < 2^24 * b, b > 0: the same number as std::fmod, without its loop.
[[nodiscard]] float remainder_of(float a, float b) noexcept;

/// A march and the leaf that it goes to.
struct AimedMarch {
    March march;
    glm::ivec3 target{0};
};

/// True if the first leaf that the march meets is its target.
[[nodiscard]] bool reaches(const LeafBitmap& leaves, const AimedMarch& aimed) noexcept;

/// Marches that are walked in step, as one alone waits for each of its sums.
inline constexpr size_t kMarchLanes = 4;
/// reaches() of each: bit i for march i. Fastest for marches that are alike.
[[nodiscard]] uint32_t reaches_each(const LeafBitmap& leaves,
                                    const std::array<AimedMarch, kMarchLanes>& marches) noexcept;

} // namespace cl::gi
