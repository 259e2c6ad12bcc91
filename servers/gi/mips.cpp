// The bytes of the GI texture (spec gi-update section 7).
#include "servers/gi/bricks.h"
#include "servers/gi/relight.h"
#include "servers/gi/s3tc.h"

#include "core/assert.h"
#include "core/threads.h"

#include <algorithm>
#include <span>

namespace cl::gi {

namespace {

/// energy / dynamic range / 4 in whole numbers, at most 255, without dividing.
class TexelByte {
public:
    explicit TexelByte(int dynamic_range) : reciprocal_((uint64_t(1) << 32) / divisor(dynamic_range) + 1) {}

    /// Exact: rounding the reciprocal up adds less than 2^16 / 2^32, which is not enough to reach the next
    /// whole number from a multiple of 1 / divisor.
    [[nodiscard]] uint8_t operator()(Energy energy) const {
        return uint8_t(std::min<uint64_t>((energy * reciprocal_) >> 32, 255));
    }

private:
    /// Beyond 65535 every energy gives 0.
    static uint64_t divisor(int dynamic_range) {
        return std::min<uint64_t>(uint64_t(std::max(dynamic_range, 1)) * 4, 65536);
    }
    uint64_t reciprocal_;
};

void encode_plain_brick(const CellLayout& layout, const CellEnergies& energies, const CellRange& cells,
                        const TexelByte& byte, const TexelBoxes::Box& box, std::span<uint8_t> rgba8) {
    std::fill(rgba8.begin(), rgba8.end(), uint8_t(0));
    for (size_t cell = cells.begin; cell < cells.end; ++cell) {
        const glm::ivec3 at = glm::ivec3(layout.voxels[cell]) - box.offset;
        uint8_t* texel = rgba8.data() + size_t((at.z * box.size.y + at.y) * box.size.x + at.x) * 4;
        for (size_t c = 0; c < 3; ++c) {
            texel[c] = byte(energies.rgb[cell * 3 + c]);
        }
        texel[3] = layout.opacity[cell];
    }
}

/// A box to be filled, and the cells that lie in it.
struct Task {
    TexelBoxes::Box box;
    CellRange cells;
};

std::vector<Task> tasks_of(const CellLayout& layout, int mip_count, const ChangedBricks& changed) {
    std::vector<Task> tasks;
    size_t bytes = 0;
    for (size_t mip = 0; mip < size_t(mip_count); ++mip) {
        const MipBricks in = bricks_of_mip(layout, mip);
        const size_t depth = in.texel_level - in.brick_level;
        const glm::ivec3 size = glm::min(layout.dims >> int(mip), glm::ivec3(1 << depth));
        CL_ASSERT(changed.mips[mip].size() == in.bricks.size(), "a flag for each brick");
        for (size_t i = 0; i < in.bricks.size(); ++i) {
            if (changed.mips[mip][i]) {
                const size_t brick = in.bricks.begin + i;
                const glm::ivec3 offset = glm::ivec3(layout.voxels[brick]) * (1 << depth);
                tasks.push_back(
                    {{int(mip), offset, size, bytes}, cells_below(layout, {brick, brick + 1}, depth)});
                bytes += tasks.back().box.bytes();
            }
        }
    }
    return tasks;
}

} // namespace

int mip_count(const glm::ivec3& dims) noexcept {
    int count = 1;
    for (int least = std::min(dims.x, std::min(dims.y, dims.z)); least > 1; least >>= 1) {
        ++count;
    }
    return count;
}

int mip_count(const CellLayout& layout, TexelCoding coding) noexcept {
    return coding == TexelCoding::Dxt5 ? block_mip_count(layout.dims) : mip_count(layout.dims);
}

void encode_bricks(const CellLayout& layout, const CellEnergies& energies, int dynamic_range,
                   TexelCoding coding, const ChangedBricks& changed, TexelBoxes& out) {
    CL_ASSERT(energies.rgb.size() == layout.cell_count() * 3, "three energies a cell");
    constexpr size_t kGrain = 32;
    const std::vector<Task> tasks = tasks_of(layout, mip_count(layout, coding), changed);
    out.boxes.clear();
    for (const Task& task : tasks) {
        out.boxes.push_back(task.box);
    }
    const size_t bytes = tasks.empty() ? 0 : tasks.back().box.first_byte + tasks.back().box.bytes();
    out.rgba8.resize(std::max(out.rgba8.size(), bytes));
    const TexelByte byte(dynamic_range);
    parallel_for(tasks.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const auto& [box, cells] = tasks[i];
            const std::span<uint8_t> rgba8 = std::span(out.rgba8).subspan(box.first_byte, box.bytes());
            if (coding == TexelCoding::Dxt5) {
                encode_block_brick(layout, energies, cells, dynamic_range, box, rgba8);
            } else {
                encode_plain_brick(layout, energies, cells, byte, box, rgba8);
            }
        }
    });
}

} // namespace cl::gi
