#pragma once

#include "core/math/aabb.h"
#include "core/math/color.h"
#include "core/math/transform.h"
#include "core/rid.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// Plain descriptions of what is drawn, shared by the scene, the server and every rasteriser. Colours are
// sRGB-encoded as in scene files unless said otherwise; whoever shades linearises them.
namespace cl {

// --- materials (spec scene-classes section 15) ---------------------------------------------------

enum class TextureChannel : uint8_t { Red, Green, Blue, Alpha, Gray };
enum class DiffuseMode : uint8_t { Burley, Lambert, LambertWrap, OrenNayar, Toon };
enum class SpecularMode : uint8_t { SchlickGGX, Blinn, Phong, Toon, Disabled };
enum class BlendMode : uint8_t { Mix, Add, Sub, Mul };
enum class CullMode : uint8_t { Back, Front, Disabled };
enum class DepthDrawMode : uint8_t { OpaqueOnly, Always, Never, AlphaOpaquePrepass };
enum class EmissionOperator : uint8_t { Add, Multiply };

/// How an instance shows in shadows. ShadowsOnly: there and nowhere else.
enum class ShadowCasting : uint8_t { Off, On, DoubleSided, ShadowsOnly };

/// A SpatialMaterial. Texture RIDs are null when not set.
struct MaterialDesc {
    bool is_default = false; ///< no material at all: white Lambert, no direct specular (spec section 4)
    bool transparent = false, unshaded = false, no_depth_test = false, do_not_receive_shadows = false;
    bool disable_ambient_light = false, vertex_color_use_as_albedo = false, vertex_color_is_srgb = false;
    bool albedo_texture_force_srgb = false, ensure_correct_normals = false, vertex_lighting = false;
    DiffuseMode diffuse_mode = DiffuseMode::Burley;
    SpecularMode specular_mode = SpecularMode::SchlickGGX;
    BlendMode blend_mode = BlendMode::Mix;
    CullMode cull_mode = CullMode::Back;
    DepthDrawMode depth_draw_mode = DepthDrawMode::OpaqueOnly;
    bool grow = false;
    float grow_amount_m = 0.0f;
    bool alpha_scissor = false;
    float alpha_scissor_threshold = 0.98f;

    Color albedo{1, 1, 1, 1};
    RID albedo_texture;
    float metallic = 0.0f;
    float specular = 0.5f;
    RID metallic_texture;
    TextureChannel metallic_channel = TextureChannel::Red;
    float roughness = 1.0f;
    RID roughness_texture;
    TextureChannel roughness_channel = TextureChannel::Red;

    bool emission_enabled = false;
    Color emission{0, 0, 0, 1};
    float emission_energy = 1.0f;
    EmissionOperator emission_operator = EmissionOperator::Add;
    bool emission_on_uv2 = false;
    RID emission_texture;

    bool normal_enabled = false;
    float normal_scale = 1.0f;
    RID normal_texture;

    bool ao_enabled = false;
    float ao_light_affect = 0.0f;
    bool ao_on_uv2 = false;
    RID ao_texture;
    TextureChannel ao_channel = TextureChannel::Red;

    glm::vec3 uv1_scale{1.0f}, uv1_offset{0.0f}, uv2_scale{1.0f}, uv2_offset{0.0f};
    bool uv1_triplanar = false;
    float uv1_triplanar_sharpness = 1.0f;
    bool world_triplanar = false;

    int render_priority = 0;

    /// Smooth enough for its reflections to show more than how much light there is.
    [[nodiscard]] bool is_glossy() const noexcept {
        return !is_default && !unshaded && (roughness < 0.7f || roughness_texture) &&
               (metallic > 0.0f || specular > 0.0f);
    }

    /// Drawn in the sorted transparent pass (spec section 15.1, last lines).
    [[nodiscard]] bool is_transparent() const noexcept {
        return blend_mode != BlendMode::Mix || no_depth_test ||
               (transparent && !alpha_scissor && depth_draw_mode != DepthDrawMode::AlphaOpaquePrepass);
    }
    /// Shows in shadow maps (spec section 9, last lines).
    [[nodiscard]] bool casts_shadow() const noexcept {
        return alpha_scissor || depth_draw_mode == DepthDrawMode::AlphaOpaquePrepass ||
               (blend_mode == BlendMode::Mix && !no_depth_test && !transparent);
    }
};

// --- lights (spec scene-classes sections 6 to 9) -------------------------------------------------

enum class LightType : uint8_t { Directional, Omni, Spot };
enum class LightBakeMode : uint8_t { Disabled, Indirect, All };
enum class DirectionalShadowMode : uint8_t { Orthogonal, PSSM2, PSSM4 };
enum class DirectionalDepthRange : uint8_t { Stable, Optimized };
enum class OmniShadowMode : uint8_t { DualParaboloid, Cube };

struct LightDesc {
    LightType type = LightType::Omni;
    Color color{1, 1, 1, 1};
    float energy = 1.0f;
    float indirect_energy = 1.0f;
    bool negative = false;
    float specular = 0.5f;
    LightBakeMode bake_mode = LightBakeMode::Indirect;
    uint32_t cull_mask = 0xFFFFFFFFu;
    bool shadow = false;
    Color shadow_color{0, 0, 0, 1};
    float shadow_bias_m = 0.15f;
    float shadow_contact_m = 0.0f;
    bool shadow_reverse_cull_face = false;
    float range_m = 5.0f;
    float attenuation = 1.0f;
    float spot_angle_deg = 45.0f; ///< half angle
    float spot_angle_attenuation = 1.0f;
    OmniShadowMode omni_shadow_mode = OmniShadowMode::Cube;
    DirectionalShadowMode directional_mode = DirectionalShadowMode::PSSM4;
    std::array<float, 3> directional_splits{0.1f, 0.2f, 0.5f};
    bool directional_blend_splits = false;
    float directional_normal_bias = 0.8f;
    float directional_bias_split_scale = 0.25f;
    DirectionalDepthRange directional_depth_range = DirectionalDepthRange::Stable;
    float directional_max_distance_m = 100.0f;
    friend bool operator==(const LightDesc&, const LightDesc&) = default;
};

/// The box an omni or spot light can reach, in light space [m] (spec gi-update section 4); empty if
/// directional. Departs from Godot for spots of 90 degrees and more, whose box it turns inside out: the whole
/// ball here.
[[nodiscard]] AABB light_bounds(const LightDesc& light) noexcept;

// --- camera (spec scene-classes section 5) -------------------------------------------------------

enum class Projection : uint8_t { Perspective, Orthogonal, Frustum };
enum class KeepAspect : uint8_t { Width, Height };

struct CameraDesc {
    Projection projection = Projection::Perspective;
    KeepAspect keep_aspect = KeepAspect::Height;
    float fov_deg = 70.0f; ///< full angle
    float size_m = 1.0f;
    glm::vec2 frustum_offset{0.0f};
    float near_m = 0.05f;
    float far_m = 100.0f;
    uint32_t cull_mask = 1048575u;
    RID environment;
    Transform world_from_camera; ///< orthonormal, h/v offset applied
};

/// Clip from view, GL conventions (z in -1..1). `size`: viewport [pixels].
[[nodiscard]] glm::mat4 projection_matrix(const CameraDesc& camera, glm::ivec2 size) noexcept;

// --- environment (spec scene-classes section 14) -------------------------------------------------

enum class BackgroundMode : uint8_t { ClearColor, Color, Sky, ColorSky, Canvas, Keep, CameraFeed };
enum class ToneMapper : uint8_t { Linear, Reinhard, Filmic, Aces };

struct EnvironmentDesc {
    BackgroundMode background_mode = BackgroundMode::ClearColor;
    RID sky;
    float sky_custom_fov_deg = 0.0f; ///< 0: the camera's
    glm::mat3 sky_orientation{1.0f};
    Color background_color{0, 0, 0, 1};
    float background_energy = 1.0f;
    Color ambient_color{0, 0, 0, 1};
    float ambient_energy = 1.0f;
    float ambient_sky_contribution = 1.0f;
    bool fog_enabled = false;
    Color fog_color{0.5f, 0.6f, 0.7f, 1.0f}, fog_sun_color{1.0f, 0.9f, 0.7f, 1.0f};
    float fog_sun_amount = 0.0f;
    bool fog_depth_enabled = true;
    float fog_depth_begin_m = 10.0f, fog_depth_end_m = 100.0f, fog_depth_curve = 1.0f;
    bool fog_transmit_enabled = false;
    float fog_transmit_curve = 1.0f;
    bool fog_height_enabled = false;
    float fog_height_min_m = 10.0f, fog_height_max_m = 0.0f, fog_height_curve = 1.0f;
    ToneMapper tone_mapper = ToneMapper::Linear;
    float exposure = 1.0f;
    float white = 1.0f;
    bool adjustment_enabled = false;
    float brightness = 1.0f, contrast = 1.0f, saturation = 1.0f;
};

/// A sky as an equirectangular panorama: linear radiance, rgb, row 0 at the zenith, x as spec section 14.2
/// maps it.
struct SkyDesc {
    glm::ivec2 size{0};          ///< [texels]
    std::vector<float> radiance; ///< size.x * size.y * 3
    int radiance_map_size = 128; ///< edge of the prefiltered map [texels]
};

// --- GI ------------------------------------------------------------------------------------------

/// How indirect light is found. Cones: per pixel, as Godot 3.2 does. Auto: radiosity on the surfaces in the
/// probes' boxes (servers/radiosity).
enum class GIMode : uint8_t { Off, Cones, Auto };
/// What keeps surfaces from shading themselves by the coarseness of their shadow map.
enum class ShadowFit : uint8_t {
    AsSet,   ///< the biases of the lights [m] and Godot's wide fit to the view
    ByTexel, ///< look-ups step off the surface by what the filter reaches: right at any scale, no knobs
};
enum class Quality : uint8_t { Low, High };

/// A probe's shading parameters, read live each frame (spec gi-shading section 2).
struct GIProbeShading {
    RID volume;                   ///< rasterizer GI volume; null until it was set up
    Transform cells_from_world;   ///< [m] -> [cells]
    glm::vec3 bounds_cells{0.0f}; ///< true size of the box [cells]
    glm::ivec3 size{0};           ///< texture size [cells]
    float multiplier = 1.0f;      ///< dynamic range * energy
    float bias_cells = 1.5f;
    float normal_bias_m = 0.0f;
    bool blend_ambient = true;

    // --- Auto: what surfaces and air receive; `volume` and `size` are then those of reflections ---
    RID field;                        ///< rasterizer GI field; null until the light is known
    Transform field_cells_from_world; ///< [m] -> [cells of the field]
    glm::vec3 field_cells{0.0f};      ///< size of the box [cells of the field]
    glm::ivec3 field_bricks{0};       ///< of 4 x 4 x 4 cells
    int field_first_brick = 0;        ///< where this probe's begin
    glm::ivec3 field_air_at{0};       ///< where its slabs of air begin [texels]
    float field_range = 1.0f;         ///< radiance of the volume's texels of 1
};

} // namespace cl
