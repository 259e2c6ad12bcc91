#include "drivers/gles3/mip_chain.h"

#include "core/assert.h"

#include <algorithm>
#include <cstddef>

namespace cl::gles3 {

namespace {

uint8_t mean4(int a, int b, int c, int d) noexcept {
    return static_cast<uint8_t>((a + b + c + d + 2) / 4);
}
float mean4(float a, float b, float c, float d) noexcept {
    return (a + b + c + d) * 0.25f;
}

template <typename Value>
void downsample(std::span<const Value> fine, glm::ivec2 size, std::span<Value> coarse) noexcept {
    const glm::ivec2 half = next_mip_size(size);
    CL_ASSERT(fine.size() == size_t(size.x) * size_t(size.y) * 4, "fine texels fill their size");
    CL_ASSERT(coarse.size() == size_t(half.x) * size_t(half.y) * 4, "coarse texels fill half the size");
    // Along an edge of length 1 both taps are the same texel.
    const size_t right = size.x > 1 ? 4 : 0;
    const size_t down = size.y > 1 ? size_t(size.x) * 4 : 0;
    for (int y = 0; y < half.y; ++y) {
        const Value* from = &fine[size_t(y) * 2 * down];
        Value* to = &coarse[size_t(y) * size_t(half.x) * 4];
        for (int x = 0; x < half.x; ++x, from += 2 * right, to += 4) {
            for (size_t c = 0; c < 4; ++c) {
                to[c] = mean4(from[c], from[c + right], from[c + down], from[c + down + right]);
            }
        }
    }
}

} // namespace

glm::ivec2 next_mip_size(glm::ivec2 size) noexcept {
    return {std::max(1, size.x / 2), std::max(1, size.y / 2)};
}

void downsample_rgba8(std::span<const uint8_t> fine, glm::ivec2 size, std::span<uint8_t> coarse) noexcept {
    downsample(fine, size, coarse);
}

void downsample_rgba32f(std::span<const float> fine, glm::ivec2 size, std::span<float> coarse) noexcept {
    downsample(fine, size, coarse);
}

} // namespace cl::gles3
