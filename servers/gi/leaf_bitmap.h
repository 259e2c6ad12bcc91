#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace cl::gi {

/// Which cells of a grid are leaves: one bit each, 64 neighbours (a brick of 4 x 4 x 4) to a word, so that a
/// ray's next steps mostly read the word it has just read. 16 MiB at 512^3.
class LeafBitmap {
public:
    LeafBitmap() = default;
    explicit LeafBitmap(const glm::ivec3& dims)
        : dims_(dims), words_x_((uint32_t(dims.x) + 3) / 4),
          words_xy_(words_x_ * ((uint32_t(dims.y) + 3) / 4)),
          words_(size_t(words_xy_) * ((uint32_t(dims.z) + 3) / 4)), free_(words_.size(), 0) {}

    void add(uint32_t x, uint32_t y, uint32_t z) noexcept { words_[word(x, y, z)] |= bit(x, y, z); }

    /// Finds how far each empty brick is from leaves; to be called after the last add().
    void measure_free_space();

    /// What a ray finds in a cell.
    struct Found {
        bool leaf = false;
        uint32_t free_steps = 0; ///< more steps of at most a cell along each axis that surely meet none
    };
    /// No leaf outside the grid, negative coordinates included.
    [[nodiscard]] Found look(int32_t x, int32_t y, int32_t z) const noexcept {
        if (uint32_t(x) >= uint32_t(dims_.x) || uint32_t(y) >= uint32_t(dims_.y) ||
            uint32_t(z) >= uint32_t(dims_.z)) {
            return {};
        }
        const size_t brick = word(uint32_t(x), uint32_t(y), uint32_t(z));
        const uint64_t leaves = words_[brick];
        return {(leaves & bit(uint32_t(x), uint32_t(y), uint32_t(z))) != 0, free_[brick]};
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
    std::vector<uint8_t> free_; ///< of each brick: Found::free_steps
};

} // namespace cl::gi
