#pragma once

#include "servers/gi/float4.h"
#include "servers/gi/leaf_bitmap.h"

#include <glm/vec3.hpp>

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

/// True if the first leaf that the march meets is `target`.
[[nodiscard]] bool reaches(const LeafBitmap& leaves, const March& march, const glm::ivec3& target) noexcept;

} // namespace cl::gi
