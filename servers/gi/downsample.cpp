// Energies of inner cells from their children (spec gi-update section 6).
#include "servers/gi/relight.h"

#include "core/assert.h"
#include "core/threads.h"

#include <algorithm>
#include <cstddef>

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

void downsample_cell(const CellLayout& layout, size_t index, float propagation, std::vector<Energy>& rgb) {
    const uint32_t first = layout.first_child[index], end = layout.first_child[index + 1];
    float sum[3] = {0.0f, 0.0f, 0.0f};
    for (size_t child = first; child < end; ++child) {
        for (size_t c = 0; c < 3; ++c) {
            sum[c] += float(rgb[child * 3 + c]);
        }
    }
    const float divisor = 8.0f + float(int(end - first) - 8) * propagation;
    for (size_t c = 0; c < 3; ++c) {
        rgb[index * 3 + c] = rounded(sum[c] / divisor);
    }
}

} // namespace

void energies_from_leaves(const CellLayout& layout, std::span<const int32_t> leaf_energies, float propagation,
                          CellEnergies& out) {
    CL_ASSERT(leaf_energies.size() == layout.leaves.size() * 3, "three energies a leaf");
    out.rgb.resize(layout.cell_count() * 3);
    const size_t first_leaf = layout.cell_count() - layout.leaves.size();
    parallel_for(leaf_energies.size(), 3 * kGrain, [&](size_t begin, size_t end) {
        std::transform(leaf_energies.begin() + ptrdiff_t(begin), leaf_energies.begin() + ptrdiff_t(end),
                       out.rgb.begin() + ptrdiff_t(first_leaf * 3 + begin), clamped);
    });
    for (int level = layout.levels - 2; level >= 0; --level) {
        const size_t first = layout.level_begin[size_t(level)];
        parallel_for(layout.level_begin[size_t(level) + 1] - first, kGrain, [&](size_t begin, size_t end) {
            for (size_t i = first + begin; i < first + end; ++i) {
                downsample_cell(layout, i, propagation, out.rgb);
            }
        });
    }
}

} // namespace cl::gi
