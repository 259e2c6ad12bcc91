#include "servers/radiosity/sky_bins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cl::radiosity {

uint32_t sky_bin(const glm::vec3& d) noexcept {
    const float row = (d.y * 0.5f + 0.5f) * float(kSkyRows);
    const float turn = std::atan2(d.z, d.x) * (0.5f / std::numbers::pi_v<float>);
    const float column = (turn - std::floor(turn)) * float(kSkyColumns);
    return std::min(uint32_t(std::max(row, 0.0f)), kSkyRows - 1) * kSkyColumns +
           std::min(uint32_t(column), kSkyColumns - 1);
}

glm::vec3 sky_direction(uint32_t bin, float u, float v) noexcept {
    const uint32_t row = bin / kSkyColumns, column = bin % kSkyColumns;
    const float y = (float(row) + v) / float(kSkyRows) * 2.0f - 1.0f;
    const float phi = (float(column) + u) / float(kSkyColumns) * 2.0f * std::numbers::pi_v<float>;
    const float r = std::sqrt(std::max(1.0f - y * y, 0.0f));
    return {r * std::cos(phi), y, r * std::sin(phi)};
}

} // namespace cl::radiosity
