#pragma once

#include "servers/radiosity/patches.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

/// A patch with the name of its cell, so that blocks of cells are runs.
struct Placed {
    uint64_t code; ///< grid, then Morton code
    uint32_t patch;
};

/// All patches in the order of their codes: the patches of a block are a run.
[[nodiscard]] std::vector<Placed> in_morton_order(const Patches& patches);

/// Blocks of level k are 2^k cells an edge; the top level's 4.
inline constexpr int kTopLevel = 2;
[[nodiscard]] inline uint64_t block_of(uint64_t code, int level) noexcept {
    return code >> (3 * level);
}
/// Runs of patches that share a block of the top level.
[[nodiscard]] std::vector<std::span<const Placed>> top_blocks(std::span<const Placed> placed);

} // namespace cl::radiosity
