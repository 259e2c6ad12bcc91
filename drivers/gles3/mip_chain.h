#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>

namespace cl::gles3 {

/// Size of the next coarser level: half, rounded down, at least 1.
[[nodiscard]] glm::ivec2 next_mip_size(glm::ivec2 size) noexcept;

/// One level of a mip chain: each coarse texel is the mean of 2x2 fine ones (of 2 or 1 along an edge of
/// length 1; the last row or column of an odd size falls out), as stored: sRGB bytes are averaged without
/// decoding, halves rounded up. Godot 3.2.3 does so: a checkerboard of 0 and 255 that is minified shows 128,
/// where the mean of the light would show 188 (measured). Done here and not by the driver so that all drivers
/// sample the same bytes. `fine`: size.x * size.y RGBA texels; `coarse`: those of next_mip_size(size).
void downsample_rgba8(std::span<const uint8_t> fine, glm::ivec2 size, std::span<uint8_t> coarse) noexcept;
void downsample_rgba32f(std::span<const float> fine, glm::ivec2 size, std::span<float> coarse) noexcept;

} // namespace cl::gles3
