#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace cl::radiosity {

/// Even spread over the unit square: term `i` of the additive recurrence with the plastic number, from a
/// start of its own. Source: Roberts 2018, "The unreasonable effectiveness of quasirandom sequences" (R2).
[[nodiscard]] inline glm::vec2 r2_point(uint32_t i, glm::vec2 start) noexcept {
    // In 32-bit fixed point, where the sum wraps as it should and every index keeps all its digits.
    const auto term = [i](float from, uint32_t step) {
        const uint32_t sum = uint32_t(double(from) * 4294967296.0) + i * step;
        return float(sum >> 8) * (1.0f / 16777216.0f);
    };
    return {term(start.x, 3242174889u), term(start.y, 2447445414u)};
}

/// A start for r2_point that differs between neighbours. Source: Jarzynski and Olano 2020 (PCG hash).
[[nodiscard]] inline glm::vec2 hashed_start(uint64_t key) noexcept {
    const auto pcg = [](uint32_t v) {
        const uint32_t state = v * 747796405u + 2891336453u;
        const uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
        return (word >> 22u) ^ word;
    };
    const uint32_t a = pcg(uint32_t(key) ^ pcg(uint32_t(key >> 32)));
    return glm::vec2(float(a >> 8), float(pcg(a) >> 8)) * (1.0f / 16777216.0f);
}

/// Directions about a normal with the density of the cosine. Source: Malley's method (PBRT 3rd ed., 13.6.3).
class CosineFrame {
public:
    explicit CosineFrame(const glm::vec3& normal) noexcept : n_(normal) {
        const glm::vec3 up = std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        s_ = glm::normalize(glm::cross(up, normal));
        t_ = glm::cross(normal, s_);
    }
    [[nodiscard]] glm::vec3 direction(glm::vec2 u) const noexcept {
        const float r = std::sqrt(u.x), phi = 2.0f * std::numbers::pi_v<float> * u.y;
        return r * std::cos(phi) * s_ + r * std::sin(phi) * t_ + std::sqrt(std::max(1.0f - u.x, 0.0f)) * n_;
    }

private:
    glm::vec3 n_, s_, t_;
};

/// Directions all around, evenly.
[[nodiscard]] inline glm::vec3 sphere_direction(glm::vec2 u) noexcept {
    const float z = 1.0f - 2.0f * u.x, r = std::sqrt(std::max(1.0f - z * z, 0.0f));
    const float phi = 2.0f * std::numbers::pi_v<float> * u.y;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

} // namespace cl::radiosity
