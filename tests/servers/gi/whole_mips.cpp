#include "tests/servers/gi/whole_mips.h"

#include "servers/gi/bricks.h"

#include <algorithm>

namespace cl::tests {

void put(const gi::CellLayout& layout, gi::TexelCoding coding, const gi::TexelBoxes& boxes,
         std::vector<MipLevel>& levels) {
    for (int m = int(levels.size()); m < gi::mip_count(layout, coding); ++m) {
        const glm::ivec3 size = layout.dims >> m;
        levels.push_back({size, std::vector<uint8_t>(size_t(size.x) * size_t(size.y) * size_t(size.z) * 4)});
    }
    for (const gi::TexelBoxes::Box& box : boxes.boxes) {
        MipLevel& level = levels[size_t(box.mip)];
        auto from = boxes.texels_of(box).begin();
        for (int z = box.offset.z; z < box.offset.z + box.size.z; ++z) {
            for (int y = box.offset.y; y < box.offset.y + box.size.y; ++y) {
                const int texel = (z * level.size.y + y) * level.size.x + box.offset.x;
                std::copy_n(from, box.size.x * 4, level.rgba8.begin() + texel * 4);
                from += box.size.x * 4;
            }
        }
    }
}

std::vector<MipLevel> whole_mips(const gi::CellLayout& layout, const gi::CellEnergies& energies,
                                 int dynamic_range, gi::TexelCoding coding) {
    gi::ChangedBricks all;
    for (size_t mip = 0; mip < size_t(layout.levels); ++mip) {
        all.mips.emplace_back(gi::bricks_of_mip(layout, mip).bricks.size(), uint8_t(1));
    }
    gi::TexelBoxes boxes;
    gi::encode_bricks(layout, energies, dynamic_range, coding, all, boxes);
    std::vector<MipLevel> levels;
    put(layout, coding, boxes, levels);
    return levels;
}

} // namespace cl::tests
