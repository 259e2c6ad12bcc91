#include "tests/servers/gi/hand_made_octree.h"

#include "servers/gi/cell_words.h"
#include "servers/gi/octree_builder.h"

#include <doctest/doctest.h>

namespace cl::tests {

namespace {

constexpr int kLevels = 7;

uint32_t child_of(gi::Octree& octree, uint32_t parent, int slot, int level) {
    if (octree.cells[parent].children[slot] == gi::kNoChild) {
        octree.cells[parent].children[slot] = uint32_t(octree.cells.size());
        octree.cells.push_back(gi::empty_cell(level));
    }
    return octree.cells[parent].children[slot];
}

/// Mean of eight, as a bake gives it to inner cells. Children come after their parents.
void set_inner_alphas(gi::Octree& octree) {
    std::vector<float> alphas(octree.cells.size(), 0.0f);
    for (size_t i = octree.cells.size(); i-- > 0;) {
        gi::Cell& cell = octree.cells[i];
        const int level = int(cell.level_alpha >> 16);
        for (const uint32_t child : cell.children) {
            alphas[i] += child == gi::kNoChild ? 0.0f : alphas[child] / 8.0f;
        }
        alphas[i] = level == kLevels - 1 ? 1.0f : alphas[i];
        cell.level_alpha = gi::encode_level_alpha(level, alphas[i]);
    }
}

} // namespace

gi::Octree make_octree(const std::vector<HandMadeLeaf>& leaves, const glm::ivec3& dims) {
    gi::Octree octree;
    octree.levels = kLevels;
    octree.dims = dims;
    octree.cells.push_back(gi::empty_cell(0));
    for (const HandMadeLeaf& leaf : leaves) {
        uint32_t cell = 0;
        for (int level = 1; level < kLevels; ++level) {
            const int bit = kLevels - 1 - level;
            const glm::ivec3 upper = (leaf.voxel >> bit) & 1;
            cell = child_of(octree, cell, upper.x + 2 * upper.y + 4 * upper.z, level);
        }
        octree.cells[cell].normal = leaf.normal;
        octree.cells[cell].albedo = leaf.albedo;
        octree.cells[cell].emission = leaf.emission;
        ++octree.leaf_count;
    }
    set_inner_alphas(octree);
    const Expected<gi::Octree> checked = gi::decode_octree(gi::encode_octree(octree));
    REQUIRE_MESSAGE(checked.has_value(), (checked ? "" : checked.error().message));
    return *checked;
}

size_t leaf_at(const gi::CellLayout& layout, const glm::ivec3& voxel) {
    size_t i = 0;
    while (i < layout.leaves.size() && glm::ivec3(layout.leaves[i].voxel) != voxel) {
        ++i;
    }
    REQUIRE(i < layout.leaves.size());
    return i;
}

} // namespace cl::tests
