#include "servers/gi/leaf_bitmap.h"

#include <algorithm>

namespace cl::gi {

void LeafBitmap::measure_free_space() {
    if (words_.empty()) {
        return;
    }
    // Chebyshev distance in bricks to the nearest brick with leaves, by one sweep there and one back
    // (Rosenfeld and Pfaltz 1966). Outside of the grid nothing is met.
    constexpr int kFar = 62; // so that steps fit a byte
    const glm::ivec3 n(int(words_x_), int(words_xy_ / words_x_), int(words_.size() / words_xy_));
    std::vector<uint8_t> away(words_.size());
    std::transform(words_.begin(), words_.end(), away.begin(),
                   [](uint64_t leaves) { return uint8_t(leaves == 0 ? kFar : 0); });
    const auto number = [&](const glm::ivec3& b) {
        return (size_t(b.z) * size_t(n.y) + size_t(b.y)) * size_t(n.x) + size_t(b.x);
    };
    const auto is_inside = [&](const glm::ivec3& b) {
        return uint32_t(b.x) < uint32_t(n.x) && uint32_t(b.y) < uint32_t(n.y) &&
               uint32_t(b.z) < uint32_t(n.z);
    };
    /// Takes what the 13 neighbours before (sign -1) or after (+1) a brick in memory offer.
    const auto relax = [&](const glm::ivec3& at, int sign) {
        uint8_t& own = away[number(at)];
        for (int i = 0; i < 13 && own > 0; ++i) {
            const glm::ivec3 next = at - sign * (glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
            if (is_inside(next)) {
                own = std::min(own, uint8_t(away[number(next)] + 1));
            }
        }
    };
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x) {
                relax({x, y, z}, -1);
            }
        }
    }
    for (int z = n.z; z-- > 0;) {
        for (int y = n.y; y-- > 0;) {
            for (int x = n.x; x-- > 0;) {
                relax({x, y, z}, 1);
            }
        }
    }
    // From anywhere in a brick d bricks away the next leaf is more than 4 (d - 1) cells off. One less, as
    // rounding may make steps a hair longer than a cell.
    std::transform(away.begin(), away.end(), free_.begin(),
                   [](uint8_t d) { return uint8_t(d > 1 ? 4 * (d - 1) - 1 : 0); });
}

} // namespace cl::gi
