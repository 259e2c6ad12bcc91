#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace cl::radiosity {

/// The sky in bins of about 6 degrees, equal in solid angle: what a ray that leaves the scene links to. Rows
/// of equal height in y (Lambert's cylindrical equal-area map), so that the mean over bins is the mean over
/// directions.
inline constexpr uint32_t kSkyRows = 32, kSkyColumns = 64, kSkyBins = kSkyRows * kSkyColumns;

[[nodiscard]] uint32_t sky_bin(const glm::vec3& direction) noexcept;
/// A unit direction inside a bin. @param u,v  place within it, 0..1
[[nodiscard]] glm::vec3 sky_direction(uint32_t bin, float u = 0.5f, float v = 0.5f) noexcept;

} // namespace cl::radiosity
