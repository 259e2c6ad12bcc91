#include "servers/gi/cone_trace.h"

#include "core/assert.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cl::gi {

VolumeSampler::VolumeSampler(std::vector<Level> levels) : levels_(std::move(levels)) {
    CL_ASSERT(!levels_.empty(), "a volume has at least one level");
    for (const Level& level : levels_) {
        CL_ASSERT(level.rgba8.size() == static_cast<size_t>(level.size.x) * level.size.y * level.size.z * 4,
                  "a level's bytes fill its size");
    }
}

glm::vec4 VolumeSampler::sample_level(const Level& level, const glm::vec3& position) const noexcept {
    const glm::vec3 p = position * glm::vec3(level.size) - 0.5f;
    const glm::vec3 base = glm::floor(p);
    const glm::vec3 f = p - base;
    glm::vec4 sum(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
        const glm::ivec3 at = glm::clamp(glm::ivec3(base) + step, glm::ivec3(0), level.size - 1);
        const glm::vec3 w = glm::mix(1.0f - f, f, glm::vec3(step));
        const size_t texel = (static_cast<size_t>(at.z) * level.size.y + at.y) * level.size.x + at.x;
        const uint8_t* b = level.rgba8.data() + texel * 4;
        sum += w.x * w.y * w.z * glm::vec4(b[0], b[1], b[2], b[3]) / 255.0f;
    }
    return sum;
}

glm::vec4 VolumeSampler::sample(const glm::vec3& position, float lod) const noexcept {
    const float last = static_cast<float>(levels_.size() - 1);
    const float clamped = std::clamp(lod, 0.0f, last);
    const auto lower = static_cast<size_t>(clamped);
    const size_t upper = std::min(lower + 1, levels_.size() - 1);
    const float t = clamped - static_cast<float>(lower);
    const glm::vec4 fine = sample_level(levels_[lower], position);
    return t == 0.0f ? fine : glm::mix(fine, sample_level(levels_[upper], position), t);
}

float cone_diameter(float distance, float tan_half_aperture) noexcept {
    return std::max(1.0f, 2.0f * tan_half_aperture * distance);
}

glm::vec4 trace_cone(const VolumeSampler& volume, const Cone& cone) noexcept {
    const glm::vec3 unit_from_voxel = 1.0f / glm::vec3(volume.size());
    glm::vec4 sum(0.0f);
    float distance = cone.first_distance;
    while (distance < cone.max_distance && sum.a < 0.95f) {
        const float diameter = cone_diameter(distance, cone.tan_half_aperture);
        const glm::vec3 at = (cone.origin + distance * cone.direction) * unit_from_voxel;
        const glm::vec4 s = volume.sample(at, std::log2(diameter));
        sum += s * (1.0f - sum.a);
        distance += diameter * 0.5f;
    }
    return sum;
}

} // namespace cl::gi
