// The bytes of the GI texture (spec gi-update section 7).
#include "servers/gi/relight.h"

#include "core/assert.h"
#include "core/threads.h"

#include <algorithm>

namespace cl::gi {

namespace {

/// Levels of zeros: no cell, no light.
std::vector<MipLevel> empty_levels(const glm::ivec3& dims) {
    std::vector<MipLevel> levels(size_t(mip_count(dims)));
    for (size_t m = 0; m < levels.size(); ++m) {
        levels[m].size = dims >> int(m);
        levels[m].rgba8.assign(
            size_t(levels[m].size.x) * size_t(levels[m].size.y) * size_t(levels[m].size.z) * 4, 0);
    }
    return levels;
}

bool has_shape_of(const std::vector<MipLevel>& levels, const glm::ivec3& dims) {
    return levels.size() == size_t(mip_count(dims)) && levels[0].size == dims;
}

uint8_t encoded(Energy energy, uint32_t dynamic_range) {
    return uint8_t(std::min((energy / dynamic_range) >> 2, 255u));
}

void encode_cell(const CellLayout& layout, const CellEnergies& energies, uint32_t index,
                 uint32_t dynamic_range, MipLevel& level) {
    const glm::u16vec3 voxel = layout.voxels[index];
    const size_t texel = (size_t(voxel.z) * size_t(level.size.y) + voxel.y) * size_t(level.size.x) + voxel.x;
    uint8_t* rgba = level.rgba8.data() + texel * 4;
    for (size_t c = 0; c < 3; ++c) {
        rgba[c] = encoded(energies.rgb[size_t(index) * 3 + c], dynamic_range);
    }
    rgba[3] = uint8_t((layout.cells[index].level_alpha & 0xFFFFu) >> 8);
}

} // namespace

int mip_count(const glm::ivec3& dims) noexcept {
    int count = 1;
    for (int least = std::min(dims.x, std::min(dims.y, dims.z)); least > 1; least >>= 1) {
        ++count;
    }
    return count;
}

void encode_mips(const CellLayout& layout, const CellEnergies& energies, int dynamic_range,
                 std::vector<MipLevel>& levels) {
    CL_ASSERT(energies.rgb.size() == layout.cells.size() * 3, "three energies a cell");
    if (!has_shape_of(levels, layout.dims)) {
        levels = empty_levels(layout.dims);
    }
    constexpr size_t kGrain = 4096;
    const uint32_t range = uint32_t(std::max(dynamic_range, 1));
    for (size_t m = 0; m < levels.size(); ++m) {
        const std::vector<uint32_t>& cells = layout.cells_of_level[size_t(layout.levels) - 1 - m];
        parallel_for(cells.size(), kGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                encode_cell(layout, energies, cells[i], range, levels[m]);
            }
        });
    }
}

} // namespace cl::gi
