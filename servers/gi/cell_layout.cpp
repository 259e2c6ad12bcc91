#include "servers/gi/cell_words.h"
#include "servers/gi/relight.h"

namespace cl::gi {

namespace {

void add_leaf(CellLayout& layout, const Cell& cell, const glm::u16vec3& voxel) {
    layout.leaves.push_back({voxel, albedo_bytes(cell.albedo), decode_normal(cell.normal), cell.emission});
    layout.leaf_bitmap.add(voxel.x, voxel.y, voxel.z);
}

} // namespace

CellLayout make_layout(const Octree& octree) {
    CellLayout layout;
    layout.levels = octree.levels;
    layout.dims = octree.dims;
    layout.leaves.reserve(octree.leaf_count);
    layout.leaf_bitmap = LeafBitmap(octree.dims);
    layout.level_begin.assign(size_t(octree.levels) + 1, 0);
    layout.first_child.assign(1, 0);
    if (octree.cells.empty()) {
        return layout;
    }
    // Breadth first: a level is done when all cells that stood in the list before it have listed theirs.
    std::vector<uint32_t> listed{0}; ///< cells of the octree
    listed.reserve(octree.cells.size());
    layout.voxels.reserve(octree.cells.size());
    layout.voxels.emplace_back(0);
    layout.first_child.clear();
    size_t at = 0;
    for (int level = 0; level < octree.levels; ++level) {
        layout.level_begin[size_t(level) + 1] = uint32_t(listed.size());
        for (const size_t end = listed.size(); at < end; ++at) {
            const Cell& cell = octree.cells[listed[at]];
            const glm::u16vec3 voxel = layout.voxels[at];
            layout.opacity.push_back(uint8_t((cell.level_alpha & 0xFFFFu) >> 8));
            if (level == octree.levels - 1) {
                add_leaf(layout, cell, voxel);
                continue;
            }
            layout.first_child.push_back(uint32_t(listed.size()));
            for (uint32_t slot = 0; slot < 8; ++slot) {
                if (cell.children[slot] != kNoChild) {
                    listed.push_back(cell.children[slot]);
                    layout.voxels.push_back(voxel * uint16_t(2) +
                                            glm::u16vec3(slot & 1, (slot >> 1) & 1, slot >> 2));
                }
            }
        }
    }
    layout.first_child.push_back(uint32_t(listed.size()));
    layout.leaf_bitmap.measure_free_space();
    return layout;
}

std::vector<int32_t> emission_energies(const CellLayout& layout) {
    std::vector<int32_t> energies;
    energies.reserve(layout.leaves.size() * 3);
    for (const CellLayout::Leaf& leaf : layout.leaves) {
        const glm::vec3 emission = decode_emission(leaf.emission);
        for (int c = 0; c < 3; ++c) {
            energies.push_back(int32_t(emission[c] * 1024.0f));
        }
    }
    return energies;
}

} // namespace cl::gi
