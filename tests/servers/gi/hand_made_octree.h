#pragma once

#include "servers/gi/probe_data.h"
#include "servers/gi/relight.h"

#include <glm/vec3.hpp>

#include <vector>

namespace cl::tests {

/// A leaf at a place of our choice.
struct HandMadeLeaf {
    glm::ivec3 voxel{0};
    uint32_t normal = 0x7F7F7F; ///< as stored
    uint32_t albedo = 0xFFFFFF;
    uint32_t emission = 0;
};

// Normals that decode to exactly +1 or -1 on their axis; the others are -1/255.
inline constexpr uint32_t kPlusX = 0xFF7F7F, kMinusX = 0x007F7F, kPlusY = 0x7FFF7F, kPlusZ = 0x7F7FFF;

/// An octree of 7 levels (64 cells an axis) with these leaves, in the order they come in. Validated.
gi::Octree make_octree(const std::vector<HandMadeLeaf>& leaves, const glm::ivec3& dims = glm::ivec3(64));

/// Place of the leaf at `voxel` in layout.leaves; fails the test if there is none.
size_t leaf_at(const gi::CellLayout& layout, const glm::ivec3& voxel);

} // namespace cl::tests
