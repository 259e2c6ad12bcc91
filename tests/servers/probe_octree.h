#pragma once

#include "servers/gi/probe_data.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace cl::tests {

/// A leaf of a hand-made octree.
struct TestVoxel {
    glm::ivec3 voxel;
    uint32_t albedo = 0xFFFFFF; ///< 0x00RRGGBB
    uint32_t normal = 0x7FFF7F; ///< 0x00XXYYZZ: up
    uint32_t emission = 0;      ///< 0xRRGGBBLL
};

/// The least tree (64 cells along the longest axis) that holds these leaves; dims are powers of two up to 64.
inline gi::Octree make_octree(glm::ivec3 dims, const std::vector<TestVoxel>& voxels) {
    constexpr int kLevels = 7;
    const auto empty_cell = [](int level) {
        gi::Cell cell{};
        for (uint32_t& child : cell.children) {
            child = gi::kNoChild;
        }
        cell.normal = 0x7F7F7F;
        cell.level_alpha = static_cast<uint32_t>(level) << 16;
        return cell;
    };
    gi::Octree octree;
    octree.levels = kLevels;
    octree.dims = dims;
    octree.leaf_count = static_cast<uint32_t>(voxels.size());
    octree.cells.push_back(empty_cell(0));
    for (const TestVoxel& v : voxels) {
        uint32_t cell = 0;
        for (int level = 1; level < kLevels; ++level) {
            const int bit = kLevels - 1 - level;
            const int slot =
                ((v.voxel.x >> bit) & 1) | ((v.voxel.y >> bit) & 1) << 1 | ((v.voxel.z >> bit) & 1) << 2;
            uint32_t child = octree.cells[cell].children[slot];
            if (child == gi::kNoChild) {
                child = static_cast<uint32_t>(octree.cells.size());
                octree.cells[cell].children[slot] = child;
                octree.cells.push_back(empty_cell(level));
            }
            cell = child;
        }
        gi::Cell& leaf = octree.cells[cell];
        leaf.albedo = v.albedo;
        leaf.emission = v.emission;
        leaf.normal = v.normal;
        leaf.level_alpha |= 0xFFFF;
    }
    for (size_t i = octree.cells.size(); i-- > 0;) { // children come after their parents
        gi::Cell& cell = octree.cells[i];
        float sum = 0.0f;
        for (uint32_t child : cell.children) {
            sum +=
                child == gi::kNoChild ? 0.0f : static_cast<float>(octree.cells[child].level_alpha & 0xFFFF);
        }
        cell.level_alpha |= static_cast<uint32_t>(sum / 8.0f);
    }
    return octree;
}

/// Data of a probe of 1 m cells whose box is centred on its origin.
inline gi::ProbeData make_probe_data(glm::ivec3 dims, const std::vector<TestVoxel>& voxels) {
    gi::ProbeData data;
    const glm::vec3 size(dims);
    data.bounds = {-0.5f * size, size};
    data.cell_size_m = 1.0f;
    data.cells_from_local.origin = 0.5f * size;
    data.dynamic_data = gi::encode_octree(make_octree(dims, voxels));
    data.dynamic_range = 4;
    data.propagation = 0.7f;
    return data;
}

/// A 16 x 8 floor at the bottom of a 64 x 8 x 8 box, with one glowing cell and a wall in its middle.
inline gi::ProbeData floor_probe_data() {
    std::vector<TestVoxel> voxels;
    for (int x = 24; x < 40; ++x) {
        for (int z = 0; z < 8; ++z) {
            TestVoxel v{.voxel = {x, 0, z}};
            v.albedo = x < 32 ? 0xC08040u : 0x40A0E0u;
            v.emission = x == 30 && z == 3 ? 0xE4720047u : 0u;
            voxels.push_back(v);
        }
    }
    for (int y = 1; y < 6; ++y) {
        for (int z = 2; z < 6; ++z) {
            voxels.push_back({.voxel = {32, y, z}, .albedo = 0xFF2020, .normal = 0xFF7F7F});
        }
    }
    return make_probe_data({64, 8, 8}, voxels);
}

} // namespace cl::tests
