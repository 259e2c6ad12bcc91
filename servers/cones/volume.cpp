#include "servers/cones/volume.h"

#include "core/assert.h"

#include <glm/common.hpp>

#include <cstring>

namespace cl::cones {

namespace {

size_t texel_count(const glm::ivec3& size) noexcept {
    return size_t(size.x) * size_t(size.y) * size_t(size.z);
}

} // namespace

Volume::Volume(const glm::ivec3& size, int levels) {
    CL_ASSERT(levels >= 1 && size.x >= 1 && size.y >= 1 && size.z >= 1, "a volume has texels");
    for (int i = 0; i < levels; ++i) {
        const glm::ivec3 s = glm::max(size >> i, glm::ivec3(1));
        const size_t beyond = size_t(s.x) * size_t(s.y) + size_t(s.x) + 1; // read with a weight of 0
        // calloc: what is not touched costs nothing.
        auto* bytes = static_cast<uint8_t*>(std::calloc(texel_count(s) + beyond, 4));
        CL_ASSERT(bytes, "memory for a volume");
        bytes_.emplace_back(bytes);
        Level level{.rgba8 = bytes, .row = 4 * s.x, .slice = 4 * s.x * s.y};
        for (int axis = 0; axis < 3; ++axis) {
            level.size[axis] = s[axis];
            level.scale[axis] = 256.0f * float(s[axis]);
            level.last[axis] = 256 * (s[axis] - 1);
        }
        levels_.push_back(level);
    }
}

void Volume::upload(int index, const glm::ivec3& offset, const glm::ivec3& size,
                    std::span<const uint8_t> rgba8) {
    CL_ASSERT(rgba8.size() == texel_count(size) * 4, "the bytes fill the box");
    const Level& level = levels_[size_t(index)];
    uint8_t* to = bytes_[size_t(index)].get();
    const uint8_t* from = rgba8.data();
    const size_t row_bytes = size_t(size.x) * 4;
    for (int z = offset.z; z < offset.z + size.z; ++z) {
        for (int y = offset.y; y < offset.y + size.y; ++y) {
            const size_t at =
                size_t(z) * size_t(level.slice) + size_t(y) * size_t(level.row) + size_t(offset.x) * 4;
            std::memcpy(to + at, from, row_bytes);
            from += row_bytes;
        }
    }
}

glm::ivec3 Volume::size(int level) const noexcept {
    const Level& l = levels_[size_t(level)];
    return {l.size[0], l.size[1], l.size[2]};
}

std::span<const uint8_t> Volume::rgba8(int level) const noexcept {
    return {levels_[size_t(level)].rgba8, texel_count(size(level)) * 4};
}

} // namespace cl::cones
