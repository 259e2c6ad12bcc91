#include "servers/shading/brdf.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace cl::shading {

namespace {

float smoothstep(float from, float to, float x) noexcept {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

} // namespace

float schlick_weight(float cosine) noexcept {
    const float m = std::clamp(1.0f - cosine, 0.0f, 1.0f);
    const float m2 = m * m;
    return m2 * m2 * m;
}

float diffuse_burley(float nl, float nv, float lh, float roughness) noexcept {
    const float cl = std::max(nl, 0.0f);
    const float f = 2.0f * lh * lh * roughness - 0.5f;
    return (1.0f + f * schlick_weight(nv)) * (1.0f + f * schlick_weight(cl)) * cl / kPi;
}

float diffuse_lambert(float nl) noexcept {
    return std::max(nl, 0.0f) / kPi;
}

float diffuse_lambert_wrap(float nl, float roughness) noexcept {
    const float w = 1.0f + roughness;
    return std::max(0.0f, (nl + roughness) / (w * w));
}

glm::vec3 diffuse_oren_nayar(float nl, float nv_signed, float lv, float roughness,
                             const glm::vec3& albedo) noexcept {
    const float s = lv - nl * nv_signed;
    const float t = s < 0.0f ? 1.0f : std::max(nl, nv_signed);
    const float sigma2 = roughness * roughness;
    const glm::vec3 a = 1.0f + sigma2 * (-0.5f / (sigma2 + 0.33f) + 0.17f * albedo / (sigma2 + 0.13f));
    const float b = 0.45f * sigma2 / (sigma2 + 0.09f);
    return std::max(nl, 0.0f) * (a + b * s / std::max(t, 1e-4f)) / kPi;
}

float diffuse_toon(float nl, float roughness) noexcept {
    return smoothstep(-roughness, std::max(roughness, 0.01f), nl);
}

glm::vec3 f0_from_material(const glm::vec3& albedo, float metallic, float specular) noexcept {
    return glm::mix(glm::vec3(0.16f * specular * specular), albedo, metallic);
}

glm::vec3 specular_ggx(float nl, float nv, float lh, float nh, float roughness,
                       const glm::vec3& f0) noexcept {
    const float cl = std::max(nl, 0.0f);
    const float alpha = roughness * roughness;
    const float d_base = 1.0f + (alpha * alpha - 1.0f) * nh * nh;
    const float d = alpha * alpha / (kPi * d_base * d_base);
    const float k = 0.5f * alpha;
    const float g = 0.25f / ((cl * (1.0f - k) + k) * (nv * (1.0f - k) + k));
    return cl * d * g * (f0 + (1.0f - f0) * schlick_weight(lh));
}

float phong_exponent(float roughness) noexcept {
    return std::exp2(15.0f * (1.0f - roughness) + 1.0f) * 0.25f;
}

float specular_blinn(float nl, float nh, float roughness) noexcept {
    const float sh = phong_exponent(roughness);
    return std::pow(nh, sh) * std::max(nl, 0.0f) * (sh + 8.0f) / (8.0f * kPi);
}

float specular_phong(float nl, float nv, float rv, float roughness) noexcept {
    const float sh = phong_exponent(roughness);
    const float lobe = std::pow(std::max(rv, 0.0f), sh) * (sh + 8.0f) / (8.0f * kPi);
    return lobe / std::max(4.0f * nv * std::max(nl, 0.0f), 0.75f);
}

float specular_toon(float rv, float roughness) noexcept {
    const float mid = (1.0f - roughness) * (1.0f - roughness);
    return smoothstep(mid - 0.5f * roughness, mid + 0.5f * roughness, rv) * mid;
}

glm::vec3 fresnel_rough(const glm::vec3& f0, float roughness, float nv) noexcept {
    const float m = 1.0f - nv;
    const float m2 = m * m;
    return f0 + (glm::max(glm::vec3(1.0f - roughness), f0) - f0) * (m2 * m2 * m);
}

glm::vec3 environment_brdf(const glm::vec3& fresnel, float roughness, float nv) noexcept {
    const glm::vec4 r =
        roughness * glm::vec4(-1.0f, -0.0275f, -0.572f, 0.022f) + glm::vec4(1.0f, 0.0425f, 1.04f, -0.04f);
    const float k = std::min(r.x * r.x, std::exp2(-9.28f * nv)) * r.x + r.y;
    return (-1.04f * k + r.z) * fresnel + (1.04f * k + r.w);
}

} // namespace cl::shading
