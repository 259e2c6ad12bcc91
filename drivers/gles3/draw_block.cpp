#include "drivers/gles3/draw_block.h"

#include "drivers/gles3/frame_block.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace cl::gles3 {

namespace {

// A march takes at least half a cell a step: these limits keep any scene's numbers from stalling a frame.
constexpr float kMaxReach = 4096.0f;
constexpr float kMaxBias = 1024.0f;

bool is_finite(const glm::vec3& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void set_place(shaders::DrawBlock& block, const DrawItem& item, const Transform& world_from_view) noexcept {
    const Transform view_from_local = world_from_view.inverse() * item.world_from_local;
    block.draw_view_from_local = view_from_local.to_mat4();
    // Godot turns normals like positions unless the material asks for more: wrong under uneven scale, but its
    // look.
    const glm::mat3 normals = item.material->ensure_correct_normals
                                  ? glm::transpose(glm::inverse(view_from_local.basis))
                                  : view_from_local.basis;
    block.draw_normal_x = glm::vec4(normals[0], 0.0f);
    block.draw_normal_y = glm::vec4(normals[1], 0.0f);
    block.draw_normal_z = glm::vec4(normals[2], 0.0f);
}

void set_emission(shaders::DrawBlock& block, const MaterialDesc& m) noexcept {
    if (!m.emission_enabled) {
        block.draw_emission_multiplies = 1; // so that whatever is bound adds nothing
        return;
    }
    const glm::vec3 color = linear_from_srgb(m.emission.rgb()) * m.emission_energy;
    const bool multiplies = m.emission_operator == EmissionOperator::Multiply;
    block.draw_emission_multiplies = multiplies;
    block.draw_emission_energy = m.emission_energy;
    block.draw_emission_on_uv2 = m.emission_on_uv2;
    // A missing texture is black: multiplied by it, nothing is left.
    block.draw_emission = multiplies && !m.emission_texture ? glm::vec3(0.0f) : color;
}

void set_material(shaders::DrawBlock& block, const MaterialDesc& m) noexcept {
    block.draw_albedo = glm::vec4(linear_from_srgb(m.albedo.rgb()), m.albedo.a);
    block.draw_metallic = m.metallic;
    block.draw_specular = m.specular;
    block.draw_roughness = m.roughness;
    block.draw_normal_scale = m.normal_scale;
    block.draw_metallic_channel = channel_mask(m.metallic_channel);
    block.draw_roughness_channel = channel_mask(m.roughness_channel);
    block.draw_ao_channel = channel_mask(m.ao_channel);
    block.draw_uv1 = glm::vec4(m.uv1_scale.x, m.uv1_scale.y, m.uv1_offset.x, m.uv1_offset.y);
    block.draw_ao_light_affect = m.ao_light_affect;
    block.draw_ao_on_uv2 = m.ao_on_uv2;
    block.draw_alpha_scissor = m.alpha_scissor_threshold;
    block.draw_grow_m = m.grow ? m.grow_amount_m : 0.0f;
    block.draw_back_side = m.cull_mode == CullMode::Back ? 1.0f : -1.0f;
    block.draw_uses_alpha = m.transparent;
    block.draw_vertex_color = m.vertex_color_use_as_albedo ? 1.0f : 0.0f;
    block.draw_vertex_color_srgb = m.vertex_color_is_srgb ? 1.0f : 0.0f;
    block.draw_receives_ambient = m.disable_ambient_light ? 0.0f : 1.0f;
    block.draw_receives_shadows = !m.do_not_receive_shadows;
}

} // namespace

glm::vec4 channel_mask(TextureChannel channel) noexcept {
    switch (channel) {
    case TextureChannel::Red:
        return {1.0f, 0.0f, 0.0f, 0.0f};
    case TextureChannel::Green:
        return {0.0f, 1.0f, 0.0f, 0.0f};
    case TextureChannel::Blue:
        return {0.0f, 0.0f, 1.0f, 0.0f};
    case TextureChannel::Alpha:
        return {0.0f, 0.0f, 0.0f, 1.0f};
    case TextureChannel::Gray:
        break;
    }
    return {0.333333f, 0.333333f, 0.333333f, 0.0f};
}

shaders::GIProbe make_gi_probe(const GIProbeShading& probe, const Transform& world_from_view,
                               bool receives_baked_light) noexcept {
    shaders::GIProbe out;
    if (probe.field && is_finite(probe.field_cells)) {
        out.cells_from_view = (probe.field_cells_from_world * world_from_view).to_mat4();
        out.bounds = probe.field_cells;
        out.multiplier = probe.multiplier;
        out.field_bricks = probe.field_bricks;
        out.field_first_brick = probe.field_first_brick;
        out.field_air_at = probe.field_air_at;
        out.field_range = probe.field_range;
        out.uv_from_cells = 1.0f / glm::vec3(glm::max(probe.size, glm::ivec3(1)));
        out.reach = probe.volume ? std::min(glm::length(probe.field_cells), kMaxReach) : 0.0f;
        return out;
    }
    if (!probe.volume || !is_finite(probe.bounds_cells)) {
        return out; // bounds of 0: no point lies inside
    }
    out.cells_from_view = (probe.cells_from_world * world_from_view).to_mat4();
    out.bounds = probe.bounds_cells;
    out.multiplier = probe.multiplier;
    out.uv_from_cells = 1.0f / glm::vec3(glm::max(probe.size, glm::ivec3(1)));
    out.bias = receives_baked_light ? std::clamp(probe.bias_cells, -kMaxBias, kMaxBias) : 0.0f;
    out.normal_bias = receives_baked_light ? probe.normal_bias_m : 0.0f;
    out.reach = std::min(glm::length(probe.bounds_cells), kMaxReach);
    out.blend_ambient = probe.blend_ambient;
    return out;
}

shaders::DrawBlock make_draw_block(const DrawItem& item, const Transform& world_from_view,
                                   std::span<const GIProbeShading> probes) noexcept {
    shaders::DrawBlock block;
    set_place(block, item, world_from_view);
    set_material(block, *item.material);
    set_emission(block, *item.material);
    block.draw_directional_mask = item.directional_mask;
    block.draw_gi_count = probe_count(item);
    for (size_t i = 0; i < item.gi_probes.size(); ++i) {
        const int index = item.gi_probes[i];
        if (index >= 0 && static_cast<size_t>(index) < probes.size()) {
            block.draw_gi[i] =
                make_gi_probe(probes[static_cast<size_t>(index)], world_from_view, item.receives_baked_light);
        }
    }
    return block;
}

} // namespace cl::gles3
