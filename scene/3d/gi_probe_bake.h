#pragma once

#include "scene/3d/bake_memory.h"
#include "scene/resources/material.h"
#include "scene/resources/mesh.h"

#include "servers/gi/probe_data.h"
#include "servers/gi/voxelizer.h"

#include "core/expected.h"
#include "core/math/transform.h"
#include "core/ref.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cl::scene {

class Node;

/// One mesh that a bake plots.
struct BakeItem {
    Transform probe_from_mesh;
    Ref<Mesh> mesh;
    std::vector<Ref<Material>> materials; ///< one a surface; null: white
};

/// What lies in a probe's box: visible MeshInstances that are used in baked light, and the bake_meshes() of
/// visible Spatials, from `start` down, parents before children (spec gi-bake section 2).
[[nodiscard]] std::vector<BakeItem> collect_bake_items(const Node& start, const Transform& world_from_probe,
                                                       const glm::vec3& extents_m);

struct BakeRequest {
    glm::vec3 extents_m{10.0f}; ///< half size of the box
    int subdivision = 128;      ///< leaf cells along the longest axis: 64, 128, 256 or 512
    Transform world_from_probe; ///< orthonormal
    /// Of the last bake, and of this one afterwards. Null: all is plotted, nothing kept.
    BakeMemory* memory = nullptr;
    std::span<const int32_t> last_result = {}; ///< dynamic_data that the last bake made; empty: lost
};

/// How large a bake was.
struct BakeFigures {
    glm::ivec3 size{0}; ///< grid [cells]
    uint32_t cells = 0; ///< of all levels
    uint32_t leaves = 0;
    int64_t triangles = 0; ///< given to the voxeliser
    size_t meshes = 0;
};

struct BakeResult {
    gi::ProbeData data; ///< box, grid and cells; the parameters are left at their defaults
    BakeFigures figures;
};

/// Voxelises what lies in the box of a probe; with a memory, what changed there since the last bake.
/// @return InvalidArgument for extents that give no grid; Cancelled if `progress` said so; OutOfMemory.
[[nodiscard]] Expected<BakeResult> bake_probe(const Node& start, const BakeRequest& request,
                                              const gi::BakeProgress& progress = {});

} // namespace cl::scene
