#include "servers/radiosity/patch_blocks.h"

#include <algorithm>

namespace cl::radiosity {
namespace {

/// Interleaves bits: neighbours in a block of 2^k cells differ in the low 3 k bits.
uint64_t morton(const glm::ivec3& cell) noexcept {
    uint64_t code = 0;
    for (int bit = 0; bit < 10; ++bit) {
        code |= uint64_t((cell.x >> bit) & 1) << (3 * bit) | uint64_t((cell.y >> bit) & 1) << (3 * bit + 1) |
                uint64_t((cell.z >> bit) & 1) << (3 * bit + 2);
    }
    return code;
}

} // namespace

std::vector<Placed> in_morton_order(const Patches& patches) {
    std::vector<Placed> out(patches.size());
    for (uint32_t p = 0; p < out.size(); ++p) {
        const Patches::Grid& grid = patches.grids[patches.grid[p]];
        out[p] = {uint64_t(patches.grid[p]) << 32 | morton(grid.cells.cell_at(patches.order[p])), p};
    }
    std::sort(out.begin(), out.end(), [](const Placed& a, const Placed& b) {
        return a.code != b.code ? a.code < b.code : a.patch < b.patch;
    });
    return out;
}

std::vector<std::span<const Placed>> top_blocks(std::span<const Placed> placed) {
    std::vector<std::span<const Placed>> runs;
    for (size_t begin = 0; begin < placed.size();) {
        size_t end = begin;
        while (end < placed.size() &&
               block_of(placed[end].code, kTopLevel) == block_of(placed[begin].code, kTopLevel)) {
            ++end;
        }
        runs.push_back(placed.subspan(begin, end - begin));
        begin = end;
    }
    return runs;
}

} // namespace cl::radiosity
