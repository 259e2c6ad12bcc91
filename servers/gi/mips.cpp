// The bytes of the GI texture (spec gi-update section 7).
#include "servers/gi/relight.h"

#include "core/assert.h"
#include "core/threads.h"

#include <algorithm>
#include <limits>
#include <span>

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

/// energy / dynamic range / 4, for every energy. A table: dividing takes longer than all else here.
std::vector<uint8_t> texel_bytes(int dynamic_range) {
    std::vector<uint8_t> bytes(size_t(std::numeric_limits<Energy>::max()) + 1);
    const uint32_t range = uint32_t(std::max(dynamic_range, 1));
    for (uint32_t energy = 0; energy < bytes.size(); ++energy) {
        bytes[energy] = uint8_t(std::min((energy / range) >> 2, 255u));
    }
    return bytes;
}

void encode_cell(const CellLayout& layout, const CellEnergies& energies, size_t index,
                 std::span<const uint8_t> bytes, MipLevel& level) {
    const glm::u16vec3 voxel = layout.voxels[index];
    const size_t texel = (size_t(voxel.z) * size_t(level.size.y) + voxel.y) * size_t(level.size.x) + voxel.x;
    uint8_t* rgba = level.rgba8.data() + texel * 4;
    for (size_t c = 0; c < 3; ++c) {
        rgba[c] = bytes[energies.rgb[index * 3 + c]];
    }
    rgba[3] = layout.opacity[index];
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
    CL_ASSERT(energies.rgb.size() == layout.cell_count() * 3, "three energies a cell");
    if (!has_shape_of(levels, layout.dims)) {
        levels = empty_levels(layout.dims);
    }
    constexpr size_t kGrain = 4096;
    const std::vector<uint8_t> bytes = texel_bytes(dynamic_range);
    for (size_t m = 0; m < levels.size(); ++m) {
        const size_t level = size_t(layout.levels) - 1 - m;
        const size_t first = layout.level_begin[level];
        parallel_for(layout.level_begin[level + 1] - first, kGrain, [&](size_t begin, size_t end) {
            for (size_t i = first + begin; i < first + end; ++i) {
                encode_cell(layout, energies, i, bytes, levels[m]);
            }
        });
    }
}

} // namespace cl::gi
