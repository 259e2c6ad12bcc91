#include "servers/gi/s3tc.h"

#include "core/assert.h"

#include <algorithm>
#include <cmath>

namespace cl::gi {

namespace {

constexpr size_t kTexels = 16;

float dot(const glm::vec3& a, const glm::vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
glm::vec3 normalized_or_zero(const glm::vec3& v) {
    const float l = std::sqrt(dot(v, v));
    return l > 0.0f ? v / l : glm::vec3(0.0f);
}

/// Bits of a fraction of 1, truncated. What is beyond 1 is clamped, as texels without blocks are.
uint32_t bits(float fraction, uint32_t most) {
    return uint32_t(std::clamp(fraction, 0.0f, 1.0f) * float(most));
}
uint16_t packed565(const glm::vec3& color) {
    return uint16_t(bits(color.r, 31) << 11 | bits(color.g, 63) << 5 | bits(color.b, 31));
}

/// The line in colour space that a block's colours are put on.
struct ColorLine {
    glm::vec3 from{0.0f}, to{0.0f};
    float distance = 0.0f; ///< what lengths along the line are divided by
};

/// The two colours farthest apart; the divisor is the square of their distance, as Godot has it.
ColorLine line_of_full_block(std::span<const BlockTexel> texels) {
    ColorLine line{texels[0].color, texels[0].color, 0.0f};
    for (size_t i = 0; i < texels.size(); ++i) {
        for (size_t j = i + 1; j < texels.size(); ++j) {
            const glm::vec3 way = texels[i].color - texels[j].color;
            const float squared = dot(way, way);
            if (squared > line.distance) {
                line = {texels[i].color, texels[j].color, squared};
            }
        }
    }
    return line;
}

/// From black, which the empty texels are, along the mean colour.
ColorLine line_of_partial_block(std::span<const BlockTexel> texels) {
    glm::vec3 sum(0.0f);
    for (const BlockTexel& t : texels) {
        sum += t.color;
    }
    const glm::vec3 direction = normalized_or_zero(sum);
    ColorLine line;
    for (const BlockTexel& t : texels) {
        line.distance = std::max(line.distance, dot(t.color, direction));
    }
    line.to = direction * line.distance;
    return line;
}

void encode_color(std::span<const BlockTexel> texels, uint8_t* out) {
    ColorLine line = texels.size() == kTexels ? line_of_full_block(texels) : line_of_partial_block(texels);
    uint16_t code0 = packed565(line.from);
    uint16_t code1 = packed565(line.to);
    if (code1 > code0) {
        std::swap(code0, code1);
        std::swap(line.from, line.to);
    }
    constexpr uint32_t kIndexOfThird[4] = {0, 3, 1, 2}; // Godot's, which is not the blocks' order
    const glm::vec3 direction = normalized_or_zero(line.to - line.from);
    uint32_t indices = 0x55555555u; // 1 where no cell is
    for (const BlockTexel& t : texels) {
        const float along = 3.0f * dot(t.color - line.from, direction) / line.distance;
        const uint32_t index =
            line.distance > 0.0f ? kIndexOfThird[size_t(std::clamp(along + 0.5f, 0.0f, 3.0f))] : 0;
        indices = (indices & ~(3u << (2 * t.place))) | index << (2 * t.place);
    }
    const uint32_t codes = uint32_t(code0) | uint32_t(code1) << 16;
    for (int i = 0; i < 4; ++i) {
        out[i] = uint8_t(codes >> (8 * i));
        out[4 + i] = uint8_t(indices >> (8 * i));
    }
}

void encode_alpha(std::span<const BlockTexel> texels, uint8_t* out) {
    std::array<int, kTexels> alphas{};
    for (const BlockTexel& t : texels) {
        alphas[size_t(t.place)] = t.alpha;
    }
    const int most = *std::max_element(alphas.begin(), alphas.end());
    const int least = texels.size() == kTexels ? *std::min_element(alphas.begin(), alphas.end()) : 0;
    uint64_t codes = 0;
    for (size_t i = 0; i < kTexels && most != least; ++i) {
        // Not negative: halves go up, as Godot's do. NOLINTNEXTLINE(bugprone-incorrect-roundings)
        const int seventh = int(float(alphas[i] - least) * 7.0f / float(most - least) + 0.5f);
        const uint64_t q = uint64_t(7 - std::min(seventh, 7));
        codes |= (q == 0 ? 0 : q == 7 ? 1 : q + 1) << (3 * i);
    }
    out[0] = uint8_t(most);
    out[1] = uint8_t(least);
    for (int i = 0; i < 6; ++i) {
        out[2 + i] = uint8_t(codes >> (8 * i));
    }
}

glm::ivec3 unpacked565(uint32_t code) {
    const int r = int(code >> 11), g = int((code >> 5) & 63u), b = int(code & 31u);
    return {r << 3 | r >> 2, g << 2 | g >> 4, b << 3 | b >> 2};
}

/// The texels of a brick by the block that they lie in, each block's in the cells' order.
class BlockTable {
public:
    explicit BlockTable(const glm::ivec3& size) : blocks_(size.x / 4, size.y / 4, size.z) {
        CL_ASSERT(count() <= texels_.size(), "a brick has 8 texels on each side");
    }

    [[nodiscard]] size_t count() const { return size_t(blocks_.x) * size_t(blocks_.y) * size_t(blocks_.z); }
    /// @param at  of the texel in the brick
    void add(const glm::ivec3& at, const BlockTexel& texel) {
        const int block = (at.z * blocks_.y + at.y / 4) * blocks_.x + at.x / 4;
        texels_[size_t(block)][counts_[size_t(block)]++] = texel;
    }
    [[nodiscard]] std::span<const BlockTexel> texels_of(size_t block) const {
        return std::span(texels_[block]).first(counts_[block]);
    }
    /// The block's first texel.
    [[nodiscard]] glm::ivec3 origin_of(size_t block) const {
        const int b = int(block);
        return {b % blocks_.x * 4, b / blocks_.x % blocks_.y * 4, b / blocks_.x / blocks_.y};
    }

private:
    static constexpr size_t kMostBlocks = 2 * 2 * 8;
    glm::ivec3 blocks_;
    std::array<size_t, kMostBlocks> counts_{};
    std::array<std::array<BlockTexel, kTexels>, kMostBlocks> texels_;
};

BlockTexel texel_of(const CellLayout& layout, const CellEnergies& energies, size_t cell, float range) {
    const Energy* e = energies.rgb.data() + cell * 3;
    const glm::u16vec3 voxel = layout.voxels[cell];
    return {int(voxel.y % 4u) * 4 + int(voxel.x % 4u),
            glm::vec3(float(e[0]), float(e[1]), float(e[2])) / range / 1024.0f, layout.opacity[cell]};
}

/// @param rgba8  of a brick of `size` texels
void write_block(const std::array<uint8_t, 64>& texels, const glm::ivec3& origin, const glm::ivec3& size,
                 std::span<uint8_t> rgba8) {
    for (int row = 0; row < 4; ++row) {
        const int line = origin.z * size.y + origin.y + row;
        std::copy_n(texels.begin() + row * 16, 16, rgba8.begin() + (line * size.x + origin.x) * 4);
    }
}

} // namespace

Dxt5Block encode_block(std::span<const BlockTexel> texels) {
    CL_ASSERT(texels.size() <= kTexels, "a block has 16 texels");
    Dxt5Block block{};
    encode_alpha(texels, block.data());
    encode_color(texels, block.data() + 8);
    return block;
}

std::array<uint8_t, 64> decode_block(const Dxt5Block& block) {
    const auto little_endian = [&block](size_t at, size_t count) {
        uint64_t value = 0;
        for (size_t i = count; i-- > 0;) {
            value = value << 8 | block[at + i];
        }
        return value;
    };
    int alphas[8] = {block[0], block[1], 0, 0, 0, 0, 0, 255};
    for (int i = 2; i < 8 && alphas[0] > alphas[1]; ++i) {
        alphas[i] = (alphas[0] * (8 - i) + alphas[1] * (i - 1)) / 7;
    }
    const glm::ivec3 c0 = unpacked565(uint32_t(little_endian(8, 2)));
    const glm::ivec3 c1 = unpacked565(uint32_t(little_endian(10, 2)));
    const glm::ivec3 colors[4] = {c0, c1, (2 * c0 + c1) / 3, (c0 + 2 * c1) / 3};
    const uint64_t alpha_codes = little_endian(2, 6), color_codes = little_endian(12, 4);
    std::array<uint8_t, 64> texels{};
    for (size_t i = 0; i < kTexels; ++i) {
        const glm::ivec3& color = colors[(color_codes >> (2 * i)) & 3u];
        for (int c = 0; c < 3; ++c) {
            texels[i * 4 + size_t(c)] = uint8_t(color[c]);
        }
        texels[i * 4 + 3] = uint8_t(alphas[(alpha_codes >> (3 * i)) & 7u]);
    }
    return texels;
}

int block_mip_count(const glm::ivec3& dims) noexcept {
    int count = 0;
    for (int least = std::min(dims.x, std::min(dims.y, dims.z)); least >= 4; least >>= 1) {
        ++count;
    }
    return count;
}

void encode_block_brick(const CellLayout& layout, const CellEnergies& energies, const CellRange& cells,
                        int dynamic_range, const TexelBoxes::Box& box, std::span<uint8_t> rgba8) {
    const float range = float(std::max(dynamic_range, 1));
    BlockTable table(box.size);
    for (size_t cell = cells.begin; cell < cells.end; ++cell) {
        table.add(glm::ivec3(layout.voxels[cell]) - box.offset, texel_of(layout, energies, cell, range));
    }
    std::fill(rgba8.begin(), rgba8.end(), uint8_t(0));
    for (size_t block = 0; block < table.count(); ++block) {
        if (const std::span<const BlockTexel> texels = table.texels_of(block); !texels.empty()) {
            write_block(decode_block(encode_block(texels)), table.origin_of(block), box.size, rgba8);
        }
    }
}

} // namespace cl::gi
