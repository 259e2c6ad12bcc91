#pragma once

#include "servers/gi/light_memory.h"
#include "servers/gi/relight.h"
#include "servers/probe/probe_light.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace cl {

/// What a probe is to be lit with next.
struct RelightOrder {
    std::vector<LightEdit> edits; ///< against what the cells hold now
    float propagation = 1.0f;
    int dynamic_range = 1; ///< >= 1
};

/// The cells of one probe: what their light is, and the texels made of it. Owned by the probe and, while
/// `busy`, used by the worker alone; a probe that is freed meanwhile lets go and the worker's share keeps it
/// alive.
struct RelightCells {
    /// @param texel_coding  Dxt5 only if gi::block_mip_count() of the layout's dims is not 0
    explicit RelightCells(std::shared_ptr<const gi::CellLayout> cell_layout,
                          gi::TexelCoding texel_coding = gi::TexelCoding::Plain);

    std::shared_ptr<const gi::CellLayout> layout;
    gi::TexelCoding coding;
    std::vector<int32_t> leaf_sums; ///< emission and all lights put in so far; empty before the first order
    gi::LightMemory lights;         ///< what some of them put in
    gi::CellEnergies energies;      ///< of the texels encoded so far
    gi::TexelBoxes texels;          ///< those that the last order may have changed; none: the texture stays
    int encoded_range = 0;          ///< dynamic range of the texels encoded so far; 0: there are none
    double work_ms = 0.0;           ///< of the last order
    std::atomic<bool> busy{false};
    std::atomic<bool> abandoned{false}; ///< the result is not wanted any more: stop early
};

/// Carries out an order: edits the leaves, spreads their energy up the tree, encodes the bricks whose
/// energies differ. Only edits cost a pass over the leaves; the bytes are those of any other history with the
/// same end. Sets `busy` to false when done.
void relight(RelightCells& cells, const RelightOrder& order);

} // namespace cl
