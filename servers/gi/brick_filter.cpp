#include "servers/gi/brick_filter.h"

#include "servers/gi/top_cells.h"

#include <glm/common.hpp>

namespace cl::gi {

namespace {

/// A brick's number has a bit of x, y and z each for every level.
uint32_t brick_number(int x, int y, int z) {
    uint32_t number = 0;
    for (int level = 0; level < kBakeBrickLevel; ++level) {
        const auto bit = [level](int coordinate) { return (uint32_t(coordinate) >> level) & 1u; };
        number |= (bit(x) | bit(y) << 1 | bit(z) << 2) << (3 * level);
    }
    return number;
}

} // namespace

BrickFilter::BrickFilter(const Grid& grid, const TopReach& bricks)
    : root_m_(grid.cubic_box.position), bricks_per_m_(float(kSide) / grid.cubic_box.size.x) {
    for (size_t i = 0; i < wanted_.size(); ++i) {
        const int n = int(i);
        wanted_[i] = bricks.has_brick(brick_number(n % kSide, n / kSide % kSide, n / (kSide * kSide)));
    }
}

bool BrickFilter::may_touch(const glm::vec3 (&v)[3]) const noexcept {
    // The exact tests round by a millionth of a brick: coordinates are at most eight bricks from the middle.
    constexpr float kMargin = 1e-3f;
    const glm::vec3 first(0.0f), last(float(kSide - 1));
    const glm::vec3 least = (glm::min(glm::min(v[0], v[1]), v[2]) - root_m_) * bricks_per_m_ - kMargin;
    const glm::vec3 most = (glm::max(glm::max(v[0], v[1]), v[2]) - root_m_) * bricks_per_m_ + kMargin;
    const glm::ivec3 from(glm::clamp(least, first, last)), to(glm::clamp(most, first, last));
    for (int z = from.z; z <= to.z; ++z) {
        for (int y = from.y; y <= to.y; ++y) {
            for (int x = from.x; x <= to.x; ++x) {
                const int brick = (z * kSide + y) * kSide + x;
                if (wanted_[size_t(brick)]) {
                    return true;
                }
            }
        }
    }
    return false;
}

} // namespace cl::gi
