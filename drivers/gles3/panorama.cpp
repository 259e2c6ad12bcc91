#include "drivers/gles3/panorama.h"

#include "core/assert.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cl::gles3 {

Panorama::Panorama(glm::ivec2 size, std::vector<glm::vec3> radiance) {
    CL_ASSERT(size.x > 0 && size.y > 0 && radiance.size() == static_cast<size_t>(size.x) * size.y,
              "the radiance fills the panorama");
    levels_.push_back({size, std::move(radiance)});
    while (levels_.back().size.x > 1 || levels_.back().size.y > 1) {
        const Level& fine = levels_.back();
        Level coarse{glm::max(fine.size / 2, glm::ivec2(1)), {}};
        coarse.texels.resize(static_cast<size_t>(coarse.size.x) * coarse.size.y);
        for (int y = 0; y < coarse.size.y; ++y) {
            for (int x = 0; x < coarse.size.x; ++x) {
                const int x0 = std::min(2 * x, fine.size.x - 1), x1 = std::min(2 * x + 1, fine.size.x - 1);
                const int y0 = std::min(2 * y, fine.size.y - 1), y1 = std::min(2 * y + 1, fine.size.y - 1);
                const auto at = [&](int i, int j) {
                    return fine.texels[static_cast<size_t>(j) * fine.size.x + i];
                };
                coarse.texels[static_cast<size_t>(y) * coarse.size.x + x] =
                    0.25f * (at(x0, y0) + at(x1, y0) + at(x0, y1) + at(x1, y1));
            }
        }
        levels_.push_back(std::move(coarse));
    }
}

glm::vec3 Panorama::sample_level(const Level& level, const glm::vec2& uv) noexcept {
    const glm::vec2 p = uv * glm::vec2(level.size) - 0.5f;
    const glm::vec2 base = glm::floor(p);
    const glm::vec2 f = p - base;
    const int x = static_cast<int>(base.x), y = static_cast<int>(base.y);
    const int x0 = x < 0 ? x + level.size.x : x;
    const int x1 = x + 1 >= level.size.x ? x + 1 - level.size.x : x + 1;
    const int y0 = std::max(y, 0), y1 = std::min(y + 1, level.size.y - 1);
    const glm::vec3* upper = level.texels.data() + static_cast<size_t>(y0) * level.size.x;
    const glm::vec3* lower = level.texels.data() + static_cast<size_t>(y1) * level.size.x;
    return glm::mix(glm::mix(upper[x0], upper[x1], f.x), glm::mix(lower[x0], lower[x1], f.x), f.y);
}

glm::vec3 Panorama::sample(const glm::vec3& direction, float lod) const noexcept {
    constexpr float kInvPi = 0.31830988618f;
    const float turn = std::atan2(direction.x, direction.z) * 0.5f * kInvPi;
    const glm::vec2 uv(turn < 0.0f ? turn + 1.0f : turn,
                       std::acos(std::clamp(direction.y, -1.0f, 1.0f)) * kInvPi);
    const float clamped = std::clamp(lod, 0.0f, static_cast<float>(levels_.size() - 1));
    const auto lower = static_cast<size_t>(clamped);
    const float t = clamped - static_cast<float>(lower);
    const glm::vec3 fine = sample_level(levels_[lower], uv);
    return t == 0.0f ? fine : glm::mix(fine, sample_level(levels_[lower + 1], uv), t);
}

} // namespace cl::gles3
