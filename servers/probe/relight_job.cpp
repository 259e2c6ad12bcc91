#include "servers/probe/relight_job.h"

#include "core/assert.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace cl {
namespace {

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
    gi::ChangedBricks changed =
        gi::energies_from_leaves(layout, cells.leaf_sums, order.propagation, cells.energies);
    if (cells.encoded_range != order.dynamic_range) {
        for (std::vector<uint8_t>& bricks : changed.mips) {
            std::fill(bricks.begin(), bricks.end(), uint8_t{1});
        }
    }
    gi::encode_bricks(layout, cells.energies, order.dynamic_range, cells.coding, changed, cells.texels);
    cells.encoded_range = order.dynamic_range;
}

} // namespace

RelightCells::RelightCells(std::shared_ptr<const gi::CellLayout> cell_layout, gi::TexelCoding texel_coding)
    : layout(std::move(cell_layout)), coding(texel_coding) {
    CL_ASSERT(gi::mip_count(*layout, coding) > 0, "blocks need four texels on each side");
}

void relight(RelightCells& cells, const RelightOrder& order) {
    const auto start = std::chrono::steady_clock::now();
    carry_out(cells, order);
    cells.work_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    cells.busy.store(false, std::memory_order_release);
}

} // namespace cl
