#include "servers/probe/relight_job.h"

#include "servers/gi/s3tc.h"

#include "core/assert.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace cl {
namespace {

/// Which mips hold a cell whose energy differs. Mip m holds the cells of level levels - 1 - m (spec section
/// 7).
std::vector<bool> changed_mips(const RelightCells& relit, const gi::CellEnergies& now) {
    const gi::CellLayout& layout = *relit.layout;
    const gi::CellEnergies& before = relit.energies;
    std::vector<bool> changed(static_cast<size_t>(relit.mip_count()), true);
    if (before.rgb.size() != now.rgb.size()) {
        return changed;
    }
    for (size_t mip = 0; mip < changed.size(); ++mip) {
        const size_t level = static_cast<size_t>(layout.levels) - 1 - mip;
        const auto first = static_cast<std::ptrdiff_t>(3 * size_t{layout.level_begin[level]});
        const auto end = static_cast<std::ptrdiff_t>(3 * size_t{layout.level_begin[level + 1]});
        changed[mip] =
            !std::equal(now.rgb.begin() + first, now.rgb.begin() + end, before.rgb.begin() + first);
    }
    return changed;
}

void carry_out(RelightCells& cells, const RelightOrder& order) {
    const gi::CellLayout& layout = *cells.layout;
    if (cells.leaf_sums.empty()) {
        cells.leaf_sums = gi::emission_energies(layout);
    }
    for (const LightEdit& edit : order.edits) {
        if (cells.abandoned) {
            return;
        }
        cells.lights.inject(layout, edit.light, edit.sign, cells.leaf_sums);
    }
    gi::CellEnergies energies;
    gi::energies_from_leaves(layout, cells.leaf_sums, order.propagation, energies);
    cells.mip_changed = cells.encoded_range == order.dynamic_range
                            ? changed_mips(cells, energies)
                            : std::vector<bool>(static_cast<size_t>(cells.mip_count()), true);
    cells.energies = std::move(energies);
    if (cells.any_mip_changed()) {
        const auto encode = cells.coding == gi::TexelCoding::Dxt5 ? gi::encode_block_mips : gi::encode_mips;
        encode(layout, cells.energies, order.dynamic_range, cells.mips);
        cells.encoded_range = order.dynamic_range;
    }
}

} // namespace

int mip_count_of(const gi::CellLayout& layout, gi::TexelCoding coding) noexcept {
    return coding == gi::TexelCoding::Dxt5 ? gi::block_mip_count(layout.dims) : gi::mip_count(layout.dims);
}

RelightCells::RelightCells(std::shared_ptr<const gi::CellLayout> cell_layout, gi::TexelCoding texel_coding)
    : layout(std::move(cell_layout)), coding(texel_coding) {
    CL_ASSERT(mip_count() > 0, "blocks need four texels on each side");
}

bool RelightCells::any_mip_changed() const {
    return std::find(mip_changed.begin(), mip_changed.end(), true) != mip_changed.end();
}

void relight(RelightCells& cells, const RelightOrder& order) {
    const auto start = std::chrono::steady_clock::now();
    carry_out(cells, order);
    cells.work_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    cells.busy.store(false, std::memory_order_release);
}

} // namespace cl
