#pragma once

#include <cstdint>

namespace cl::cones {

/// One level of a volume. Plain data: the kernel is compiled for other processors than all else, and may
/// share no inline function with it.
struct Level {
    const uint8_t* rgba8 =
        nullptr; ///< x fastest, then y, then z; the bytes of one more slice, row and texel follow
    int32_t size[3] = {1, 1, 1};               ///< [texels]
    int32_t row = 4, slice = 4;                ///< from one to the next [bytes]
    float scale[3] = {256.0f, 256.0f, 256.0f}; ///< of uv to 256 parts of a texel
    int32_t last[3] = {0, 0, 0};               ///< middle of the last texel, from that of the first [parts]
};

} // namespace cl::cones
