#include "drivers/embree/bsdf.h"

#include "drivers/embree/warp.h"

#include "servers/shading/brdf.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl::embree {

namespace {

constexpr float kLeastCosine = 1e-4f; // of the eye: below, no microfacet is visible

float largest(const glm::vec3& v) noexcept {
    return std::max({v.x, v.y, v.z});
}

float roughness_of(const Bsdf& bsdf) noexcept {
    return std::clamp(bsdf.roughness, kLeastRoughness, 1.0f);
}

/// Share of light from all around that the specular lobe takes from the diffuse one.
glm::vec3 specular_share(const Bsdf& bsdf, float nv) noexcept {
    return bsdf.gloss * shading::fresnel_rough(bsdf.f0, roughness_of(bsdf), std::clamp(nv, 0.0f, 1.0f));
}

/// Chance of choosing the specular lobe: by what each lobe may reflect, both kept possible where both exist.
float specular_chance(const Bsdf& bsdf, float nv) noexcept {
    const float specular = nv > kLeastCosine ? largest(specular_share(bsdf, nv)) : 0.0f;
    const float diffuse = largest(bsdf.diffuse);
    if (specular <= 0.0f) {
        return 0.0f;
    }
    return diffuse <= 0.0f ? 1.0f : std::clamp(specular / (specular + diffuse), 0.1f, 0.9f);
}

/// Diffuse reflection for albedo 1, with the cosine.
glm::vec3 diffuse_term(const Bsdf& bsdf, const glm::vec3& to_eye, const glm::vec3& to_light) noexcept {
    const float nl = glm::dot(bsdf.normal, to_light);
    const float nv = glm::dot(bsdf.normal, to_eye);
    switch (bsdf.diffuse_mode) {
    case DiffuseMode::Burley: {
        const float lh = std::max(0.0f, glm::dot(to_light, glm::normalize(to_light + to_eye)));
        return glm::vec3(shading::diffuse_burley(nl, std::max(nv, 0.0f), lh, bsdf.roughness));
    }
    case DiffuseMode::OrenNayar:
        return glm::max(glm::vec3(0.0f), shading::diffuse_oren_nayar(nl, nv, glm::dot(to_light, to_eye),
                                                                     bsdf.roughness, bsdf.diffuse));
    case DiffuseMode::Lambert:
    case DiffuseMode::LambertWrap:
    case DiffuseMode::Toon:
        break;
    }
    return glm::vec3(shading::diffuse_lambert(nl));
}

void add_specular(const Bsdf& bsdf, const glm::vec3& to_eye, const glm::vec3& to_light, float chance,
                  Scattering& sum) noexcept {
    const float nl = glm::dot(bsdf.normal, to_light);
    const float nv = glm::dot(bsdf.normal, to_eye);
    const glm::vec3 half_way = glm::normalize(to_light + to_eye);
    const float nh = std::max(0.0f, glm::dot(bsdf.normal, half_way));
    const float lh = std::max(0.0f, glm::dot(to_light, half_way));
    const float roughness = roughness_of(bsdf);
    const float alpha = roughness * roughness;
    const float base = 1.0f + (alpha * alpha - 1.0f) * nh * nh; // as in specular_ggx(): errors cancel
    const float density = alpha * alpha / (kPi * base * base);
    sum.specular = bsdf.gloss * shading::specular_ggx(nl, nv, lh, nh, roughness, bsdf.f0);
    sum.pdf += chance * density * ggx_visible_share(nv, alpha) / (4.0f * nv);
}

} // namespace

Scattering evaluate_bsdf(const Bsdf& bsdf, const glm::vec3& to_eye, const glm::vec3& to_light) noexcept {
    const float nl = glm::dot(bsdf.normal, to_light);
    if (!(nl > 0.0f)) {
        return {};
    }
    const float nv = glm::dot(bsdf.normal, to_eye);
    const float chance = specular_chance(bsdf, nv);
    Scattering sum;
    sum.diffuse = bsdf.diffuse * (1.0f - specular_share(bsdf, nv)) * diffuse_term(bsdf, to_eye, to_light);
    sum.pdf = (1.0f - chance) * nl / kPi;
    if (chance > 0.0f) {
        add_specular(bsdf, to_eye, to_light, chance, sum);
    }
    return sum;
}

std::optional<ScatteredDirection> sample_bsdf(const Bsdf& bsdf, const glm::vec3& to_eye, float u_lobe,
                                              const glm::vec2& u) noexcept {
    const Basis basis(bsdf.normal);
    const glm::vec3 eye = basis.to_local(to_eye);
    glm::vec3 direction;
    if (u_lobe < specular_chance(bsdf, eye.z)) {
        const float roughness = roughness_of(bsdf);
        const glm::vec3 half_way = visible_ggx_normal(eye, roughness * roughness, u);
        direction = basis.to_world(2.0f * glm::dot(eye, half_way) * half_way - eye);
    } else {
        direction = basis.to_world(cosine_hemisphere(u));
    }
    direction = glm::normalize(direction);
    const Scattering scattering = evaluate_bsdf(bsdf, to_eye, direction);
    if (!(scattering.pdf > 0.0f) || !(largest(scattering.sum()) > 0.0f)) {
        return std::nullopt;
    }
    return ScatteredDirection{direction, scattering};
}

} // namespace cl::embree
