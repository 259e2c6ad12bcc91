#include "drivers/embree/warp.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl::embree {

Basis::Basis(const glm::vec3& n) noexcept : normal(n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    tangent = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
}

glm::vec3 Basis::to_world(const glm::vec3& local) const noexcept {
    return tangent * local.x + bitangent * local.y + normal * local.z;
}

glm::vec3 Basis::to_local(const glm::vec3& world) const noexcept {
    return {glm::dot(world, tangent), glm::dot(world, bitangent), glm::dot(world, normal)};
}

glm::vec3 cosine_hemisphere(const glm::vec2& u) noexcept {
    const float radius = std::sqrt(u.x);
    const float turn = 2.0f * kPi * u.y;
    return {radius * std::cos(turn), radius * std::sin(turn), std::sqrt(std::max(0.0f, 1.0f - u.x))};
}

glm::vec2 uniform_triangle(const glm::vec2& u) noexcept {
    const float root = std::sqrt(u.x);
    return {root * (1.0f - u.y), root * u.y};
}

glm::vec3 visible_ggx_normal(const glm::vec3& to_eye, float alpha, const glm::vec2& u) noexcept {
    const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * to_eye.x, alpha * to_eye.y, to_eye.z));
    const float length2 = stretched.x * stretched.x + stretched.y * stretched.y;
    const glm::vec3 across = length2 > 0.0f ? glm::vec3(-stretched.y, stretched.x, 0.0f) / std::sqrt(length2)
                                            : glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 along = glm::cross(stretched, across);
    const float radius = std::sqrt(u.x);
    const float turn = 2.0f * kPi * u.y;
    const float x = radius * std::cos(turn);
    const float s = 0.5f * (1.0f + stretched.z);
    const float y = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - x * x)) + s * radius * std::sin(turn);
    const float z = std::sqrt(std::max(0.0f, 1.0f - x * x - y * y));
    const glm::vec3 normal = x * across + y * along + z * stretched;
    return glm::normalize(glm::vec3(alpha * normal.x, alpha * normal.y, std::max(1e-6f, normal.z)));
}

float ggx_visible_share(float cosine, float alpha) noexcept {
    const float a2 = alpha * alpha;
    return 2.0f * cosine / (cosine + std::sqrt(a2 + (1.0f - a2) * cosine * cosine));
}

float power_heuristic(float pdf, float other) noexcept {
    if (std::isinf(pdf) || other == 0.0f) {
        return 1.0f;
    }
    const float ratio = other / pdf; // of densities: squares of them would overflow
    return 1.0f / (1.0f + ratio * ratio);
}

} // namespace cl::embree
