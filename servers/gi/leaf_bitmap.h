#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace cl::gi {

/// Which cells of a grid are leaves: one bit each, 64 neighbours (4 x 4 x 4) to a word, so that a ray's next
/// steps mostly read the word it has just read. 16 MiB at 512^3.
class LeafBitmap {
public:
    LeafBitmap() = default;
    explicit LeafBitmap(const glm::ivec3& dims)
        : dims_(dims), words_x_((uint32_t(dims.x) + 3) / 4),
          words_xy_(words_x_ * ((uint32_t(dims.y) + 3) / 4)),
          words_(size_t(words_xy_) * ((uint32_t(dims.z) + 3) / 4)) {}

    void add(uint32_t x, uint32_t y, uint32_t z) noexcept { words_[word(x, y, z)] |= bit(x, y, z); }

    /// False outside the grid, negative coordinates included.
    [[nodiscard]] bool contains(int32_t x, int32_t y, int32_t z) const noexcept {
        if (uint32_t(x) >= uint32_t(dims_.x) || uint32_t(y) >= uint32_t(dims_.y) ||
            uint32_t(z) >= uint32_t(dims_.z)) {
            return false;
        }
        return (words_[word(uint32_t(x), uint32_t(y), uint32_t(z))] &
                bit(uint32_t(x), uint32_t(y), uint32_t(z))) != 0;
    }

private:
    [[nodiscard]] size_t word(uint32_t x, uint32_t y, uint32_t z) const noexcept {
        return size_t(z >> 2) * words_xy_ + (y >> 2) * words_x_ + (x >> 2);
    }
    [[nodiscard]] static uint64_t bit(uint32_t x, uint32_t y, uint32_t z) noexcept {
        return uint64_t(1) << ((x & 3u) | ((y & 3u) << 2) | ((z & 3u) << 4));
    }

    glm::ivec3 dims_{0};
    uint32_t words_x_ = 0;
    uint32_t words_xy_ = 0;
    std::vector<uint64_t> words_;
};

} // namespace cl::gi
