#pragma once

#include "scene/resources/server_rid.h"
#include "scene/resources/sky.h"
#include "scene/resources/watched_ref.h"

#include "servers/render_types.h"

#include "core/math/color.h"
#include "core/object/resource.h"

#include <glm/mat3x3.hpp>

#include <array>
#include <cstdint>
#include <utility>

namespace cl::scene {

/// Effects that are stored and written back but not drawn (spec scene-classes section 14.1).
struct EnvironmentEffects {
    bool auto_exposure = false;
    float auto_exposure_scale = 0.4f, auto_exposure_min_luma = 0.05f, auto_exposure_max_luma = 8.0f;
    float auto_exposure_speed = 0.5f;

    bool ssr = false;
    int ssr_max_steps = 64;
    float ssr_fade_in = 0.15f, ssr_fade_out = 2.0f, ssr_depth_tolerance = 0.2f;
    bool ssr_roughness = true;

    bool ssao = false;
    float ssao_radius = 1.0f, ssao_intensity = 1.0f, ssao_radius2 = 0.0f, ssao_intensity2 = 1.0f;
    float ssao_bias = 0.01f, ssao_light_affect = 0.0f, ssao_ao_channel_affect = 0.0f;
    Color ssao_color{0, 0, 0, 1};
    int ssao_quality = 1, ssao_blur = 3;
    float ssao_edge_sharpness = 4.0f;

    bool dof_far = false;
    float dof_far_distance = 10.0f, dof_far_transition = 5.0f, dof_far_amount = 0.1f;
    int dof_far_quality = 1;
    bool dof_near = false;
    float dof_near_distance = 2.0f, dof_near_transition = 1.0f, dof_near_amount = 0.1f;
    int dof_near_quality = 1;

    bool glow = false;
    std::array<bool, 7> glow_levels{false, false, true, false, true, false, false};
    float glow_intensity = 0.8f, glow_strength = 1.0f, glow_bloom = 0.0f;
    int glow_blend_mode = 2;
    float glow_hdr_threshold = 1.0f, glow_hdr_luminance_cap = 12.0f, glow_hdr_scale = 2.0f;
    bool glow_bicubic_upscale = false;

    int canvas_max_layer = 0;
    int camera_feed_id = 1;
};

/// Background, ambient light, fog and tone mapping of a world or a camera.
class Environment final : public Resource {
public:
    static constexpr std::string_view kClassName = "Environment";
    static void bind(ClassBuilder<Environment>& c);
    Environment();

    /// The drawn part; `sky` is always null here: see sky().
    [[nodiscard]] const EnvironmentDesc& desc() const noexcept { return desc_; }
    void set_desc(const EnvironmentDesc& desc);
    [[nodiscard]] const EnvironmentEffects& effects() const noexcept { return effects_; }
    void set_effects(const EnvironmentEffects& effects);
    [[nodiscard]] const Ref<Sky>& sky() const noexcept { return sky_.get(); }
    void set_sky(Ref<Sky> sky);
    /// One-dimensional look-up texture of the adjustments; stored only.
    [[nodiscard]] const Ref<Texture>& color_correction() const noexcept { return color_correction_; }
    void set_color_correction(Ref<Texture> texture) { color_correction_ = std::move(texture); }

    /// The environment as the server takes it: desc() with the sky's RID in `server`.
    [[nodiscard]] EnvironmentDesc describe(VisualServer& server) const;
    /// The environment in `server`, made on the first call; later changes go to the same RID.
    [[nodiscard]] RID rid(VisualServer& server) const;

private:
    void environment_changed();

    EnvironmentDesc desc_;
    EnvironmentEffects effects_;
    WatchedRef<Sky> sky_;
    Ref<Texture> color_correction_;
    mutable ServerRID rid_;
};

} // namespace cl::scene
