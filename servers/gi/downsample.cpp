// Energies of inner cells from their children (spec gi-update section 6).
#include "servers/gi/bricks.h"
#include "servers/gi/relight.h"

#include "core/assert.h"
#include "core/threads.h"

#include <algorithm>

namespace cl::gi {

namespace {

constexpr size_t kGrain = 32; ///< bricks

Energy clamped(int32_t energy) {
    return Energy(std::clamp(energy, 0, 65535));
}

/// Rounds halves away from zero; what is negative or NaN (propagation beyond 1) gives 0.
Energy rounded(float energy) {
    return energy > 0.0f ? Energy(std::min(energy + 0.5f, 65535.0f)) : Energy(0);
}

/// @return whether the values differ.
bool replace(Energy& energy, Energy by) {
    const bool differs = energy != by;
    energy = by;
    return differs;
}

bool clamp_leaves(std::span<const int32_t> sums, std::span<Energy> energies) {
    bool changed = false;
    for (size_t i = 0; i < sums.size(); ++i) {
        changed |= replace(energies[i], clamped(sums[i]));
    }
    return changed;
}

bool downsample_cell(const CellLayout& layout, size_t index, float propagation, std::vector<Energy>& rgb) {
    const uint32_t first = layout.first_child[index], end = layout.first_child[index + 1];
    int32_t sum[3] = {0, 0, 0};
    for (size_t child = first; child < end; ++child) {
        for (size_t c = 0; c < 3; ++c) {
            sum[c] += rgb[child * 3 + c];
        }
    }
    const float divisor = 8.0f + float(int(end - first) - 8) * propagation;
    bool changed = false;
    for (size_t c = 0; c < 3; ++c) {
        changed |= replace(rgb[index * 3 + c], rounded(float(sum[c]) / divisor));
    }
    return changed;
}

bool downsample_cells(const CellLayout& layout, const CellRange& cells, float propagation,
                      std::vector<Energy>& rgb) {
    bool changed = false;
    for (size_t cell = cells.begin; cell < cells.end; ++cell) {
        changed |= downsample_cell(layout, cell, propagation, rgb);
    }
    return changed;
}

/// Calls `update(brick)` for each brick of a mip. @return 1 for each of which it returned true.
template <typename Update>
std::vector<uint8_t> update_bricks(const MipBricks& mip, const Update& update) {
    std::vector<uint8_t> changed(mip.bricks.size(), 0);
    parallel_for(changed.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            changed[i] = update(mip.bricks.begin + i) ? 1 : 0;
        }
    });
    return changed;
}

/// @param below  the mip that these bricks are summed from, and @param changed_below  its changed bricks
std::vector<uint8_t> downsample_mip(const CellLayout& layout, const MipBricks& mip, const MipBricks& below,
                                    std::span<const uint8_t> changed_below, float propagation,
                                    std::vector<Energy>& rgb) {
    // A brick below covers an eighth of one of these; near the root both are the root.
    const size_t down = below.brick_level - mip.brick_level;
    return update_bricks(mip, [&](size_t brick) {
        const CellRange parts = cells_below(layout, {brick, brick + 1}, down);
        bool changed = false;
        for (size_t part = parts.begin; part < parts.end; ++part) {
            if (changed_below.empty() || changed_below[part - below.bricks.begin]) {
                const CellRange texels =
                    cells_below(layout, {part, part + 1}, mip.texel_level - below.brick_level);
                changed |= downsample_cells(layout, texels, propagation, rgb);
            }
        }
        return changed;
    });
}

} // namespace

ChangedBricks energies_from_leaves(const CellLayout& layout, std::span<const int32_t> leaf_energies,
                                   float propagation, CellEnergies& energies) {
    CL_ASSERT(leaf_energies.size() == layout.leaves.size() * 3, "three energies a leaf");
    const bool are_new = energies.rgb.size() != layout.cell_count() * 3;
    const bool all_inner = are_new || energies.propagation != propagation;
    energies.rgb.resize(layout.cell_count() * 3);
    energies.propagation = propagation;
    ChangedBricks changed;
    const size_t first_leaf = layout.cell_count() - layout.leaves.size();
    MipBricks below = bricks_of_mip(layout, 0);
    changed.mips.push_back(update_bricks(below, [&](size_t brick) {
        const CellRange leaves =
            cells_below(layout, {brick, brick + 1}, below.texel_level - below.brick_level);
        return clamp_leaves(leaf_energies.subspan((leaves.begin - first_leaf) * 3, leaves.size() * 3),
                            std::span(energies.rgb).subspan(leaves.begin * 3, leaves.size() * 3));
    }));
    for (size_t mip = 1; mip < size_t(layout.levels); ++mip) {
        const MipBricks bricks = bricks_of_mip(layout, mip);
        const std::span<const uint8_t> changed_below =
            all_inner ? std::span<const uint8_t>() : changed.mips.back();
        changed.mips.push_back(
            downsample_mip(layout, bricks, below, changed_below, propagation, energies.rgb));
        below = bricks;
    }
    for (std::vector<uint8_t>& bricks : changed.mips) {
        if (are_new) {
            std::fill(bricks.begin(), bricks.end(), uint8_t(1));
        }
    }
    return changed;
}

} // namespace cl::gi
