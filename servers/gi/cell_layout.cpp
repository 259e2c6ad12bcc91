#include "servers/gi/cell_words.h"
#include "servers/gi/relight.h"

namespace cl::gi {

namespace {

/// Walks the tree in slot order, children before their parent. Depth is at most 10 levels.
class LayoutWalk {
public:
    explicit LayoutWalk(CellLayout& layout) : layout_(layout) {}

    void visit(uint32_t index, int level, const glm::uvec3& origin) {
        const uint32_t child_size = level < layout_.levels - 1 ? 1u << (layout_.levels - 2 - level) : 0;
        for (uint32_t slot = 0; slot < 8; ++slot) {
            const uint32_t child = layout_.cells[index].children[slot];
            if (child != kNoChild) {
                visit(child, level + 1,
                      origin + child_size * glm::uvec3(slot & 1, (slot >> 1) & 1, slot >> 2));
            }
        }
        layout_.voxels[index] = glm::u16vec3(origin >> uint32_t(layout_.levels - 1 - level));
        layout_.cells_of_level[size_t(level)].push_back(index);
        if (level == layout_.levels - 1) {
            add_leaf(index);
        }
    }

private:
    void add_leaf(uint32_t index) {
        const Cell& cell = layout_.cells[index];
        const glm::u16vec3 voxel = layout_.voxels[index];
        layout_.leaves.push_back({index, voxel, albedo_bytes(cell.albedo), decode_normal(cell.normal)});
        layout_.leaf_bitmap.add(voxel.x, voxel.y, voxel.z);
    }

    CellLayout& layout_;
};

} // namespace

CellLayout make_layout(const Octree& octree) {
    CellLayout layout;
    layout.levels = octree.levels;
    layout.dims = octree.dims;
    layout.cells = octree.cells;
    layout.voxels.resize(octree.cells.size(), glm::u16vec3(0));
    layout.cells_of_level.resize(size_t(octree.levels));
    layout.cells_of_level.back().reserve(octree.leaf_count);
    layout.leaves.reserve(octree.leaf_count);
    layout.leaf_bitmap = LeafBitmap(octree.dims);
    if (!octree.cells.empty()) {
        LayoutWalk(layout).visit(0, 0, glm::uvec3(0));
    }
    return layout;
}

std::vector<int32_t> emission_energies(const CellLayout& layout) {
    std::vector<int32_t> energies;
    energies.reserve(layout.leaves.size() * 3);
    for (const CellLayout::Leaf& leaf : layout.leaves) {
        const glm::vec3 emission = decode_emission(layout.cells[leaf.cell].emission);
        for (int c = 0; c < 3; ++c) {
            energies.push_back(int32_t(emission[c] * 1024.0f));
        }
    }
    return energies;
}

} // namespace cl::gi
