#pragma once

#include "servers/radiosity/solver.h"
#include "servers/radiosity/transport.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

/// How a pixel finds the patches around it in the probes' grids: what stays while light changes. A cell has a
/// list of patches for each of six facings (+x, -x, +y, -y, +z, -z of the grid); a pixel asks for the one
/// nearest its normal. A patch knows which of the 26 cells around it hold surface that goes on from its own,
/// and interpolation uses those alone: it cannot reach across a wall, however thin.
struct FieldMap {
    static constexpr int kFacings = 6;
    static constexpr uint32_t kSlots = 2; ///< patches of a cell and facing: the sides of a wall on one floor

    struct Probe {
        glm::ivec3 bricks{0};     ///< of one facing
        uint32_t first_brick = 0; ///< its bricks: x fastest, then y, then z, then facing
        glm::ivec3 air_at{0};     ///< where its four slabs of air begin, one behind the other
    };
    std::vector<Probe> probes;
    /// Texels of air: columns along z of the probes' slabs, at most 2048 long, side by side along x.
    glm::ivec3 air{0};

    /// CellIndex::Brick as four words each. `first` counts cells of all facings and probes.
    std::vector<uint32_t> brick_words;
    /// Patch of each slot, slot `s` of cell `c` at kSlots * c + s; kNoPatch where there is none.
    std::vector<uint32_t> patches;
    /// Two words a slot: bits 0 to 26 of the first: cells around (x fastest, itself at 13) that go on from
    /// here; of the second: the slot that does, but for bit 13: pixels tell the cell's slots apart by
    /// SlotTest::Normal. Bits 27 to 31 and 27 to 30: where SlotPlaces puts the patch, 3 bits an axis. Bit 31
    /// of the second: the cell's second slot is in use.
    std::vector<uint32_t> joints;
};

[[nodiscard]] FieldMap make_field_map(const Transport& transport);

/// Light that arrives at each slot, as shared-exponent RGB (9, 9, 9, 5 bits).
[[nodiscard]] std::vector<uint32_t> encode_field(const FieldMap& map, const Solution& solution);

} // namespace cl::radiosity
