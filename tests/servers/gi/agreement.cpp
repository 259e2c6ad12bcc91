#include "tests/servers/gi/agreement.h"

#include <cstdlib>
#include <map>

namespace cl::tests {

namespace {

/// Cells by place: level and origin, so that trees whose arrays are in different orders can be compared.
using CellMap = std::map<uint64_t, const gi::Cell*>;

void add_cells(const gi::Octree& tree, uint32_t index, int level, glm::ivec3 origin, CellMap& map) {
    const gi::Cell& cell = tree.cells[index];
    map[(uint64_t(level) << 60) | (uint64_t(origin.z) << 40) | (uint64_t(origin.y) << 20) |
        uint64_t(origin.x)] = &cell;
    const int half = level < tree.levels - 1 ? 1 << (tree.levels - 2 - level) : 0;
    for (int slot = 0; slot < 8; ++slot) {
        if (cell.children[slot] != gi::kNoChild) {
            const glm::ivec3 bits(slot & 1, (slot >> 1) & 1, slot >> 2);
            add_cells(tree, cell.children[slot], level + 1, origin + bits * half, map);
        }
    }
}

void compare_words(const gi::Cell& a, const gi::Cell& b, Agreement& result) {
    const auto compare = [&](uint32_t x, uint32_t y, int count) {
        for (int i = 0; i < count; ++i) {
            const int difference = std::abs(int((x >> (8 * i)) & 255u) - int((y >> (8 * i)) & 255u));
            ++result.bytes;
            result.equal += difference == 0;
            result.within_one += difference <= 1;
        }
    };
    compare(a.albedo, b.albedo, 3);
    compare(a.emission, b.emission, 4);
    compare(a.normal, b.normal, 3);
    compare(a.level_alpha, b.level_alpha, 2);
}

} // namespace

Agreement agreement(const gi::Octree& ours, const gi::Octree& theirs) {
    CellMap our_cells, their_cells;
    add_cells(ours, 0, 0, glm::ivec3(0), our_cells);
    add_cells(theirs, 0, 0, glm::ivec3(0), their_cells);
    const uint64_t leaf_level = uint64_t(ours.levels - 1);
    Agreement result;
    for (const auto& [place, cell] : our_cells) {
        const auto found = their_cells.find(place);
        if ((place >> 60) < leaf_level) {
            ++result.inner;
            result.inner_equal +=
                found != their_cells.end() && found->second->level_alpha == cell->level_alpha;
        } else if (found == their_cells.end()) {
            ++result.ours_only;
        } else {
            ++result.common;
            const size_t off = result.bytes - result.within_one;
            compare_words(*cell, *found->second, result);
            result.leaves_within_one += result.bytes - result.within_one == off;
        }
    }
    for (const auto& [place, cell] : their_cells) {
        result.theirs_only += (place >> 60) == leaf_level && our_cells.find(place) == our_cells.end();
    }
    return result;
}

} // namespace cl::tests
