#pragma once

#include "core/digest.h"
#include "core/image.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cl::gi {

/// Edge of a captured material map [texels].
inline constexpr int kCaptureSize = 128;

/// One quantity of a material as the bake sees it: one colour, or kCaptureSize^2 texels, row 0 first. Texels
/// stay bytes and are looked up in a table: a bake's maps then fit the caches.
class CapturedMap {
public:
    CapturedMap(const glm::vec3& color = glm::vec3(0.0f)); // NOLINT(google-explicit-constructor): is a map
    /// texel / 255 * scale + offset. @param rgba8  kCaptureSize^2 texels
    CapturedMap(Image rgba8, const glm::vec3& scale, const glm::vec3& offset);

    [[nodiscard]] size_t size() const noexcept { return texels_.size() / 4; }
    /// @param texel  below kCaptureSize^2, also of a map of one colour
    [[nodiscard]] glm::vec3 operator[](size_t texel) const noexcept {
        const uint8_t* bytes = &texels_[4 * (texel & mask_)];
        return {of_byte_[bytes[0]].r, of_byte_[bytes[1]].g, of_byte_[bytes[2]].b};
    }

    /// Adds all that it shows.
    void add_to(Digester& digester) const;

private:
    std::vector<uint8_t> texels_;
    size_t mask_; ///< 0 for one colour
    std::array<glm::vec3, 256> of_byte_;
};

} // namespace cl::gi
