#pragma once

#include "servers/gi/bricks.h"
#include "servers/gi/relight.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cl::gi {

// The texels of a probe whose data asks for compression: Godot 3.2.3 packs them into DXT5 blocks, 4 x 4
// texels of a slice each, by a quick fit with faults that show (spec gi-update section 7.1). Software
// rasterisers and GLES have no block-compressed 3D textures, so what a block decodes to is uploaded instead:
// the same picture, not the memory saved.

/// Alpha's eight bytes, then colour's eight.
using Dxt5Block = std::array<uint8_t, 16>;

/// A texel of a block that holds a cell.
struct BlockTexel {
    int place = 0;         ///< y * 4 + x in the block
    glm::vec3 color{0.0f}; ///< energy / dynamic range, 1 = full
    uint8_t alpha = 0;
};

/// @param texels  at most 16, in the order of the level's cells, each place once.
[[nodiscard]] Dxt5Block encode_block(std::span<const BlockTexel> texels);

/// @return rgba8 of the 16 texels, x fastest
[[nodiscard]] std::array<uint8_t, 64> decode_block(const Dxt5Block& block);

/// Levels of a compressed texture: dims are halved until one of them is 4. 0 if one is less: such a volume is
/// not compressed.
[[nodiscard]] int block_mip_count(const glm::ivec3& dims) noexcept;

/// The texels of one brick, by way of blocks.
/// @param cells  those of the brick
/// @param rgba8  box.bytes() of them, replaced; the box has a multiple of 4 texels along x and y, at most 8
void encode_block_brick(const CellLayout& layout, const CellEnergies& energies, const CellRange& cells,
                        int dynamic_range, const TexelBoxes::Box& box, std::span<uint8_t> rgba8);

} // namespace cl::gi
