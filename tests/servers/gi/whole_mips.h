#pragma once

#include "servers/gi/relight.h"

#include <cstdint>
#include <vector>

namespace cl::tests {

/// One texture level: RGBA8, x fastest, then y, then z.
struct MipLevel {
    glm::ivec3 size{0};
    std::vector<uint8_t> rgba8;
};

/// Puts the boxes into the texture that the levels are; makes it, all 0, if there are none.
void put(const gi::CellLayout& layout, gi::TexelCoding coding, const gi::TexelBoxes& boxes,
         std::vector<MipLevel>& levels);

/// The whole texture of these energies.
std::vector<MipLevel> whole_mips(const gi::CellLayout& layout, const gi::CellEnergies& energies,
                                 int dynamic_range, gi::TexelCoding coding = gi::TexelCoding::Plain);

} // namespace cl::tests
