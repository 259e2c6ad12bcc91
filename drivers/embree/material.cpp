#include "drivers/embree/material.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl::embree {

namespace {

DiffuseMode diffuse_mode_of(const MaterialDesc& desc) noexcept {
    return desc.is_default || desc.vertex_lighting ? DiffuseMode::Lambert : desc.diffuse_mode;
}

SpecularMode specular_mode_of(const MaterialDesc& desc) noexcept {
    if (desc.is_default) {
        return SpecularMode::Disabled;
    }
    return desc.vertex_lighting ? SpecularMode::Blinn : desc.specular_mode;
}

float channel_of(const glm::vec4& texel, TextureChannel channel) noexcept {
    switch (channel) {
    case TextureChannel::Red:
        return texel.r;
    case TextureChannel::Green:
        return texel.g;
    case TextureChannel::Blue:
        return texel.b;
    case TextureChannel::Alpha:
        return texel.a;
    case TextureChannel::Gray:
        break;
    }
    return (texel.r + texel.g + texel.b) * 0.333333f;
}

} // namespace

Material::Material(const MaterialDesc& desc, const FindTexture& find)
    : desc_(desc), diffuse_mode_(diffuse_mode_of(desc)), specular_mode_(specular_mode_of(desc)),
      albedo_(linear_from_srgb(desc.albedo.rgb()), desc.albedo.a),
      emission_(linear_from_srgb(desc.emission.rgb())), albedo_map_(find(desc.albedo_texture)),
      metallic_map_(find(desc.metallic_texture)), roughness_map_(find(desc.roughness_texture)),
      emission_map_(find(desc.emission_texture)), normal_map_(find(desc.normal_texture)),
      ao_map_(desc.ao_enabled ? find(desc.ao_texture) : nullptr) {}

glm::vec2 Material::uv1(const SurfaceCoordinates& at) const noexcept {
    return at.uv * glm::vec2(desc_.uv1_scale) + glm::vec2(desc_.uv1_offset);
}

glm::vec4 Material::albedo_and_alpha(const SurfaceCoordinates& at) const noexcept {
    glm::vec4 albedo = albedo_;
    if (albedo_map_) {
        albedo *= albedo_map_->sample(uv1(at));
    }
    if (desc_.vertex_color_use_as_albedo) {
        albedo *= at.color;
    }
    return albedo;
}

float Material::opacity(const SurfaceCoordinates& at) const noexcept {
    if (!has_holes()) {
        return 1.0f;
    }
    const float alpha = albedo_and_alpha(at).a;
    if (desc_.alpha_scissor && alpha < desc_.alpha_scissor_threshold) {
        return 0.0f;
    }
    return desc_.transparent ? std::clamp(alpha, 0.0f, 1.0f) : 1.0f;
}

glm::vec3 Material::albedo(const SurfaceCoordinates& at) const noexcept {
    return glm::vec3(albedo_and_alpha(at));
}

float Material::metallic(const SurfaceCoordinates& at) const noexcept {
    const float map =
        metallic_map_ ? channel_of(metallic_map_->sample(uv1(at)), desc_.metallic_channel) : 1.0f;
    return std::clamp(desc_.metallic * map, 0.0f, 1.0f);
}

float Material::roughness(const SurfaceCoordinates& at) const noexcept {
    const float map =
        roughness_map_ ? channel_of(roughness_map_->sample(uv1(at)), desc_.roughness_channel) : 1.0f;
    return std::clamp(desc_.roughness * map, 0.0f, 1.0f);
}

float Material::ambient_occlusion(const SurfaceCoordinates& at) const noexcept {
    return ao_map_ ? channel_of(ao_map_->sample(desc_.ao_on_uv2 ? at.uv2 : uv1(at)), desc_.ao_channel) : 1.0f;
}

bool Material::emits() const noexcept {
    const bool textured_sum = emission_map_ && desc_.emission_operator == EmissionOperator::Add;
    return desc_.unshaded || (desc_.emission_enabled && desc_.emission_energy != 0.0f &&
                              (textured_sum || emission_ != glm::vec3(0.0f)));
}

glm::vec3 Material::emission(const SurfaceCoordinates& at) const noexcept {
    if (desc_.unshaded) {
        return albedo(at);
    }
    if (!desc_.emission_enabled) {
        return glm::vec3(0.0f);
    }
    const bool multiplies = desc_.emission_operator == EmissionOperator::Multiply;
    glm::vec3 texel(0.0f); // a missing texture is black: multiplied by it, nothing is left
    if (emission_map_) {
        texel = glm::vec3(emission_map_->sample(desc_.emission_on_uv2 ? at.uv2 : uv1(at)));
    }
    return (multiplies ? emission_ * texel : emission_ + texel) * desc_.emission_energy;
}

glm::vec3 Material::tangent_normal(const SurfaceCoordinates& at) const noexcept {
    const glm::vec2 xy = glm::vec2(normal_map_->sample(uv1(at))) * 2.0f - 1.0f;
    return {xy, std::sqrt(std::max(0.0f, 1.0f - glm::dot(xy, xy)))};
}

} // namespace cl::embree
