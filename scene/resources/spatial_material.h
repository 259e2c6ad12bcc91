#pragma once

#include "scene/resources/material.h"
#include "scene/resources/texture.h"
#include "scene/resources/watched_ref.h"

#include "servers/render_types.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace cl::scene {

enum class BillboardMode : uint8_t { Disabled, Enabled, FixedY, Particles };
enum class DistanceFadeMode : uint8_t { Disabled, PixelAlpha, PixelDither, ObjectDither };
enum class DetailUV : uint8_t { UV1, UV2 };

/// Everything of a SpatialMaterial but its textures, with the defaults of spec scene-classes section 15.
/// Colours are sRGB-encoded. What no renderer of ours draws is stored and written back.
struct SpatialParams {
    bool transparent = false, shadow_to_opacity = false, unshaded = false, vertex_lighting = false;
    bool no_depth_test = false, use_point_size = false, world_triplanar = false, fixed_size = false;
    bool albedo_tex_force_srgb = false, do_not_receive_shadows = false, disable_ambient_light = false;
    bool ensure_correct_normals = false;
    bool vertex_color_use_as_albedo = false, vertex_color_is_srgb = false;

    DiffuseMode diffuse_mode = DiffuseMode::Burley;
    SpecularMode specular_mode = SpecularMode::SchlickGGX;
    BlendMode blend_mode = BlendMode::Mix;
    CullMode cull_mode = CullMode::Back;
    DepthDrawMode depth_draw_mode = DepthDrawMode::OpaqueOnly;
    float line_width = 1.0f;
    float point_size = 1.0f;
    BillboardMode billboard_mode = BillboardMode::Disabled;
    bool billboard_keep_scale = false;
    bool grow = false;
    float grow_amount_m = 0.0f;
    bool use_alpha_scissor = false;
    float alpha_scissor_threshold = 0.98f;
    int particles_anim_h_frames = 1, particles_anim_v_frames = 1;
    bool particles_anim_loop = false;

    Color albedo{1, 1, 1, 1};
    float metallic = 0.0f;
    float specular = 0.5f;
    TextureChannel metallic_channel = TextureChannel::Red;
    float roughness = 1.0f;
    TextureChannel roughness_channel = TextureChannel::Red;

    bool emission_enabled = false;
    Color emission{0, 0, 0, 1};
    float emission_energy = 1.0f;
    EmissionOperator emission_operator = EmissionOperator::Add;
    bool emission_on_uv2 = false;

    bool normal_enabled = false;
    float normal_scale = 1.0f;
    bool rim_enabled = false;
    float rim = 1.0f;
    float rim_tint = 0.5f;
    bool clearcoat_enabled = false;
    float clearcoat = 1.0f;
    float clearcoat_gloss = 0.5f;
    bool anisotropy_enabled = false;
    float anisotropy = 0.0f;
    bool ao_enabled = false;
    float ao_light_affect = 0.0f;
    bool ao_on_uv2 = false;
    TextureChannel ao_channel = TextureChannel::Red;
    bool depth_enabled = false;
    float depth_scale = 0.05f;
    bool depth_deep_parallax = false;
    int depth_min_layers = 8, depth_max_layers = 32;
    bool depth_flip_tangent = false, depth_flip_binormal = false;
    bool subsurf_scatter_enabled = false;
    float subsurf_scatter_strength = 0.0f;
    bool transmission_enabled = false;
    Color transmission{0, 0, 0, 1};
    bool refraction_enabled = false;
    float refraction_scale = 0.05f;
    TextureChannel refraction_channel = TextureChannel::Red;
    bool detail_enabled = false;
    BlendMode detail_blend_mode = BlendMode::Mix;
    DetailUV detail_uv_layer = DetailUV::UV1;

    glm::vec3 uv1_scale{1.0f}, uv1_offset{0.0f};
    bool uv1_triplanar = false;
    float uv1_triplanar_sharpness = 1.0f;
    glm::vec3 uv2_scale{1.0f}, uv2_offset{0.0f};
    bool uv2_triplanar = false;
    float uv2_triplanar_sharpness = 1.0f;

    bool proximity_fade = false;
    float proximity_fade_distance_m = 1.0f;
    DistanceFadeMode distance_fade_mode = DistanceFadeMode::Disabled;
    float distance_fade_min_m = 0.0f, distance_fade_max_m = 10.0f;
};

enum class TextureSlot : uint8_t {
    Albedo,
    Metallic,
    Roughness,
    Emission,
    Normal,
    Rim,
    Clearcoat,
    AnisotropyFlow,
    AmbientOcclusion,
    Depth,
    SubsurfaceScattering,
    Transmission,
    Refraction,
    DetailMask,
    DetailAlbedo,
    DetailNormal,
    Count,
};

/// The standard surface: metallic-roughness with the optional features of Godot 3.
class SpatialMaterial final : public Material {
public:
    static constexpr std::string_view kClassName = "SpatialMaterial";
    static void bind(ClassBuilder<SpatialMaterial>& c);
    SpatialMaterial();

    [[nodiscard]] const SpatialParams& params() const noexcept { return params_; }
    void set_params(const SpatialParams& params);
    [[nodiscard]] const Ref<Texture>& texture(TextureSlot slot) const noexcept {
        return textures_[static_cast<size_t>(slot)].get();
    }
    void set_texture(TextureSlot slot, Ref<Texture> texture);

    [[nodiscard]] MaterialDesc describe(VisualServer& server) const override;
    [[nodiscard]] BakeMaterial bake_material() const override;

private:
    SpatialParams params_;
    std::array<WatchedRef<Texture>, static_cast<size_t>(TextureSlot::Count)> textures_;
};

} // namespace cl::scene
