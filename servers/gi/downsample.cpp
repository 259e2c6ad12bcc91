// Energies of inner cells from their children (spec gi-update section 6).
#include "servers/gi/relight.h"

#include "core/assert.h"
#include "core/threads.h"

#include <algorithm>

namespace cl::gi {

namespace {

constexpr size_t kGrain = 4096;

Energy clamped(int32_t energy) {
    return Energy(std::clamp(energy, 0, 65535));
}

/// Rounds halves away from zero; what is negative or NaN (propagation beyond 1) gives 0.
Energy rounded(float energy) {
    return energy > 0.0f ? Energy(std::min(energy + 0.5f, 65535.0f)) : Energy(0);
}

void downsample_cell(const CellLayout& layout, uint32_t index, float propagation, std::vector<Energy>& rgb) {
    float sum[3] = {0.0f, 0.0f, 0.0f};
    int count = 0;
    for (const uint32_t child : layout.cells[index].children) {
        if (child == kNoChild) {
            continue;
        }
        ++count;
        for (size_t c = 0; c < 3; ++c) {
            sum[c] += float(rgb[size_t(child) * 3 + c]);
        }
    }
    const float divisor = 8.0f + float(count - 8) * propagation;
    for (size_t c = 0; c < 3; ++c) {
        rgb[size_t(index) * 3 + c] = rounded(sum[c] / divisor);
    }
}

} // namespace

void energies_from_leaves(const CellLayout& layout, std::span<const int32_t> leaf_energies, float propagation,
                          CellEnergies& out) {
    CL_ASSERT(leaf_energies.size() == layout.leaves.size() * 3, "three energies a leaf");
    out.rgb.resize(layout.cells.size() * 3);
    parallel_for(layout.leaves.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            for (size_t c = 0; c < 3; ++c) {
                out.rgb[size_t(layout.leaves[i].cell) * 3 + c] = clamped(leaf_energies[i * 3 + c]);
            }
        }
    });
    for (int level = layout.levels - 2; level >= 0; --level) {
        const std::vector<uint32_t>& cells = layout.cells_of_level[size_t(level)];
        parallel_for(cells.size(), kGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                downsample_cell(layout, cells[i], propagation, out.rgb);
            }
        });
    }
}

} // namespace cl::gi
