#pragma once

#include "core/image.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cl {

/// Size of the next coarser mip: each edge halved and rounded down, at least 1.
[[nodiscard]] glm::ivec2 half_size(glm::ivec2 size) noexcept;

/// One mip by box filter: each coarse texel is the mean of its 2x2 fine texels, of 2x1 where an edge is 1
/// already. Bytes are averaged as they are, whatever curve encodes them, and rounded to nearest, as GL
/// drivers do for non-sRGB textures. The last column or row of an odd edge has no part in it.
/// @param fine    size.x * size.y * channels values, row by row, channels together
/// @param coarse  as many of half_size(size); must not overlap `fine`
void downsample_half(std::span<const uint8_t> fine, glm::ivec2 size, int channels,
                     std::span<uint8_t> coarse) noexcept;
void downsample_half(std::span<const float> fine, glm::ivec2 size, int channels,
                     std::span<float> coarse) noexcept;

/// Mips 1, 2, ... of the image down to 1x1; empty for an image of one texel.
[[nodiscard]] std::vector<Image> build_mips(const Image& image);

} // namespace cl
