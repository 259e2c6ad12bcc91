#include "servers/gi/captured_map.h"

#include "core/assert.h"

#include <utility>

namespace cl::gi {

CapturedMap::CapturedMap(const glm::vec3& color) : texels_(4, 0), mask_(0) {
    of_byte_.fill(color);
}

CapturedMap::CapturedMap(Image rgba8, const glm::vec3& scale, const glm::vec3& offset)
    : texels_(std::move(rgba8.data)), mask_(size_t(kCaptureSize) * kCaptureSize - 1) {
    CL_ASSERT(rgba8.format == PixelFormat::RGBA8 && rgba8.size == glm::ivec2(kCaptureSize) &&
                  size() == mask_ + 1,
              "a picture of the size of a map");
    for (size_t byte = 0; byte < of_byte_.size(); ++byte) {
        for (int c = 0; c < 3; ++c) {
            // In double until the end: albedo bytes are truncated later, so the last bit decides some of
            // them.
            of_byte_[byte][c] = float(double(byte) / 255.0 * double(scale[c]) + double(offset[c]));
        }
    }
}

void CapturedMap::add_to(Digester& digester) const {
    digester.add(std::span<const uint8_t>(texels_));
    for (const glm::vec3& color : of_byte_) {
        digester.add(color.x).add(color.y).add(color.z);
    }
}

} // namespace cl::gi
