#include "drivers/embree/lamp.h"

#include "drivers/embree/warp.h"

#include "servers/shading/brdf.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl::embree {

namespace {

/// The vectors of a reflection and their cosines, as servers/shading/brdf.h names them.
struct Cosines {
    float nl, nv_signed, nv, lh, nh, lv, rv;
};

Cosines cosines_of(const glm::vec3& normal, const glm::vec3& to_eye, const glm::vec3& to_lamp) noexcept {
    const glm::vec3 half_way = glm::normalize(to_eye + to_lamp);
    const float nv = glm::dot(normal, to_eye);
    return {glm::dot(normal, to_lamp),
            nv,
            std::max(nv, 0.0f),
            std::max(glm::dot(to_lamp, half_way), 0.0f),
            std::max(glm::dot(normal, half_way), 0.0f),
            glm::dot(to_lamp, to_eye),
            glm::dot(glm::reflect(-to_lamp, normal), to_eye)};
}

glm::vec3 diffuse_term(DiffuseMode mode, const Cosines& c, float roughness,
                       const glm::vec3& albedo) noexcept {
    switch (mode) {
    case DiffuseMode::Burley:
        return glm::vec3(shading::diffuse_burley(c.nl, c.nv, c.lh, roughness));
    case DiffuseMode::Lambert:
        break;
    case DiffuseMode::LambertWrap:
        return glm::vec3(shading::diffuse_lambert_wrap(c.nl, roughness));
    case DiffuseMode::OrenNayar:
        return shading::diffuse_oren_nayar(c.nl, c.nv_signed, c.lv, roughness, albedo);
    case DiffuseMode::Toon:
        return glm::vec3(shading::diffuse_toon(c.nl, roughness));
    }
    return glm::vec3(shading::diffuse_lambert(c.nl));
}

glm::vec3 specular_term(SpecularMode mode, const Cosines& c, float roughness, const glm::vec3& f0) noexcept {
    switch (mode) {
    case SpecularMode::SchlickGGX:
        return shading::specular_ggx(c.nl, c.nv, c.lh, c.nh, roughness, f0);
    case SpecularMode::Blinn:
        return glm::vec3(shading::specular_blinn(c.nl, c.nh, roughness));
    case SpecularMode::Phong:
        return glm::vec3(shading::specular_phong(c.nl, c.nv, c.rv, roughness));
    case SpecularMode::Toon: // part of the diffuse light: see reflect_lamp()
    case SpecularMode::Disabled:
        break;
    }
    return glm::vec3(0.0f);
}

} // namespace

Lamp::Lamp(const LightItem& item)
    : type_(item.desc->type), position_(item.world_from_light.origin),
      axis_(glm::normalize(item.world_from_light.basis[2])),
      color_(linear_from_srgb(item.desc->color.rgb()) *
             (item.desc->energy * kPi * (item.desc->negative ? -1.0f : 1.0f))),
      shadow_color_(linear_from_srgb(item.desc->shadow_color.rgb())), range_m_(item.desc->range_m),
      exponent_(item.desc->attenuation), cos_angle_(std::cos(glm::radians(item.desc->spot_angle_deg))),
      angle_exponent_(item.desc->spot_angle_attenuation), specular_(item.desc->specular),
      bounce_factor_(item.desc->bake_mode == LightBakeMode::Disabled ? 0.0f : item.desc->indirect_energy),
      cull_mask_(item.desc->cull_mask), shadow_(item.desc->shadow) {}

float Lamp::attenuation(const glm::vec3& to_lamp, float distance_m) const noexcept {
    const float d = distance_m / std::max(0.001f, range_m_);
    const float by_distance = d < 1.0f ? std::pow(1.0f - d, exponent_) : 0.0f;
    if (type_ == LightType::Omni || by_distance == 0.0f) {
        return by_distance;
    }
    const float cosine = std::max(glm::dot(axis_, to_lamp), cos_angle_);
    const float rim = std::max(0.0001f, (1.0f - cosine) / std::max(1.0f - cos_angle_, 1e-6f));
    return by_distance * (1.0f - std::pow(rim, angle_exponent_));
}

std::optional<Lamp::Arrival> Lamp::arrival(const SurfacePoint& at) const noexcept {
    if ((cull_mask_ & at.item->layers) == 0) {
        return std::nullopt;
    }
    Arrival arrival;
    arrival.to_lamp = axis_;
    arrival.color = color_;
    if (type_ != LightType::Directional) {
        const glm::vec3 way = position_ - at.position;
        arrival.distance_m = glm::length(way);
        arrival.to_lamp = way / std::max(arrival.distance_m, 1e-6f);
        arrival.color *= attenuation(arrival.to_lamp, arrival.distance_m);
    }
    return arrival.color != glm::vec3(0.0f) ? std::optional(arrival) : std::nullopt;
}

glm::vec3 reflect_lamp(const SurfacePoint& at, const Lamp::Arrival& arrival, float specular_factor) noexcept {
    const Bsdf& bsdf = at.bsdf;
    const Cosines c = cosines_of(bsdf.normal, at.to_eye, arrival.to_lamp);
    const SpecularMode mode = at.item->material.specular_mode();
    glm::vec3 diffuse = at.albedo * diffuse_term(bsdf.diffuse_mode, c, bsdf.roughness, at.albedo);
    glm::vec3 specular(0.0f);
    if (bsdf.roughness > 0.0f) {
        if (mode == SpecularMode::Toon) { // so that metals lose it with the rest
            diffuse += specular_factor * 2.0f * at.item->material.desc().specular *
                       shading::specular_toon(c.rv, bsdf.roughness);
        }
        specular = specular_factor * specular_term(mode, c, bsdf.roughness, bsdf.f0);
    }
    return (diffuse * (1.0f - at.metallic) + specular) * arrival.color * at.occlusion_lamp;
}

} // namespace cl::embree
