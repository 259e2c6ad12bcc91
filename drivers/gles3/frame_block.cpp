#include "drivers/gles3/frame_block.h"

#include "servers/shading/background.h"

#include "core/assert.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl::gles3 {

namespace {

using shaders::FrameBlock;

constexpr float kPi = 3.14159265359f;

void set_environment(FrameBlock& block, const Frame& frame) noexcept {
    if (!frame.has_environment) {
        block.frame_ambient_color = linear_from_srgb(frame.clear_color.rgb());
        block.frame_ambient_energy = 1.0f;
        block.frame_environment = block.frame_ambient_color;
        block.frame_background_energy = 1.0f;
        return;
    }
    const EnvironmentDesc& e = frame.environment;
    block.frame_ambient_color = linear_from_srgb(e.ambient_color.rgb());
    block.frame_ambient_energy = e.ambient_energy;
    block.frame_environment = shading::background_color(frame) * e.background_energy;
    block.frame_background_energy = e.background_energy;
    block.frame_sky_contribution = e.ambient_sky_contribution;
}

/// Sky maps are looked up in world directions turned back by the sky's orientation, with z mirrored.
glm::mat4 sky_from_view(const Frame& frame) noexcept {
    const glm::mat3 mirror(1, 0, 0, 0, 1, 0, 0, 0, -1);
    const glm::mat3 sky_from_world = glm::inverse(frame.environment.sky_orientation);
    return glm::mat4(mirror * sky_from_world * frame.camera.world_from_camera.basis);
}

void set_fog(FrameBlock& block, const Frame& frame) noexcept {
    const EnvironmentDesc& e = frame.environment;
    block.frame_fog_color = glm::vec4(linear_from_srgb(e.fog_color.rgb()), e.fog_color.a);
    block.frame_fog_sun_color = linear_from_srgb(e.fog_sun_color.rgb());
    block.frame_fog_sun_amount = e.fog_sun_amount;
    block.frame_fog_depth_on = e.fog_depth_enabled;
    block.frame_fog_depth_begin = e.fog_depth_begin_m;
    block.frame_fog_depth_end = e.fog_depth_end_m > 0.0f ? e.fog_depth_end_m : frame.camera.far_m;
    block.frame_fog_depth_curve = e.fog_depth_curve;
    block.frame_fog_transmit_on = e.fog_transmit_enabled;
    block.frame_fog_transmit_curve = e.fog_transmit_curve;
    block.frame_fog_height_on = e.fog_height_enabled;
    block.frame_fog_height_min = e.fog_height_min_m;
    block.frame_fog_height_max = e.fog_height_max_m;
    block.frame_fog_height_curve = e.fog_height_curve;
}

/// Directions, weights and march of the two qualities (spec gi-shading section 4).
void set_cones(FrameBlock& block, Quality quality) noexcept {
    if (quality == Quality::Low) {
        constexpr float s = 0.707107f;
        block.frame_cone_count = 4;
        block.frame_cones[0] = {s, 0.0f, s, 0.25f};
        block.frame_cones[1] = {0.0f, s, s, 0.25f};
        block.frame_cones[2] = {-s, 0.0f, s, 0.25f};
        block.frame_cones[3] = {0.0f, -s, s, 0.25f};
        block.frame_cone_tan = 0.98269f;
        block.frame_cone_reach = 0.5f;
        block.frame_specular_least_tan = 0.2f;
        return;
    }
    block.frame_cone_count = 6;
    block.frame_cones[0] = {0.0f, 0.0f, 1.0f, 0.25f};
    block.frame_cones[1] = {0.866025f, 0.0f, 0.5f, 0.15f};
    block.frame_cones[2] = {0.267617f, 0.823639f, 0.5f, 0.15f};
    block.frame_cones[3] = {-0.700629f, 0.509037f, 0.5f, 0.15f};
    block.frame_cones[4] = {-0.700629f, -0.509037f, 0.5f, 0.15f};
    block.frame_cones[5] = {0.267617f, -0.823639f, 0.5f, 0.15f};
    block.frame_cone_tan = 0.577f;
    block.frame_cone_reach = 1.0f;
    block.frame_specular_least_tan = 0.0f;
}

void set_directional_shadow(shaders::DirectionalLight& out, const PlacedDirectionalShadow& placed,
                            const Transform& world_from_view) noexcept {
    const DirectionalShadow& shadow = placed.shadow;
    const glm::mat4 rows = glm::transpose((shadow.light_from_world * world_from_view).to_mat4());
    out.shadow_row_x = rows[0];
    out.shadow_row_y = rows[1];
    out.shadow_row_z = rows[2];
    out.splits = shadow.count;
    out.fade_begin = shadow.fade_begin_m;
    out.fade_end = shadow.fade_end_m;
    out.shadow_step = shadow.splits[0].bias.step_texels;
    for (int i = 0; i < kMaxSplits && shadow.count > 0; ++i) {
        // A shadow of fewer splits repeats its last.
        const DirectionalSplit& s = shadow.splits[static_cast<size_t>(std::min(i, shadow.count - 1))];
        const glm::vec3 size = s.high_m - s.low_m;
        const glm::vec2 scale = placed.area.size * s.tile_size / glm::vec2(size);
        const glm::vec2 corner = placed.area.position + placed.area.size * s.tile;
        out.split_uv[static_cast<size_t>(i)] = glm::vec4(scale, corner - glm::vec2(s.low_m) * scale);
        const glm::vec2 half_texel = glm::vec2(0.5f / static_cast<float>(placed.map_size));
        out.split_limits[static_cast<size_t>(i)] =
            glm::vec4(corner + half_texel, corner + placed.area.size * s.tile_size - half_texel);
        out.split_depth[static_cast<size_t>(i)] =
            glm::vec4(-1.0f / size.z, s.high_m.z / size.z, s.end_m, s.begin_m);
    }
}

/// Godot 3.2 draws a pass for each directional light. The passes after the first add emission, and ambient
/// light where there is no GI, again (spec scene-classes section 8), and if one light has had its shadow, the
/// others have none (seen in its pictures). GIMode::Cones shows it as Godot does, the other modes what the
/// scene says.
void imitate_light_passes(FrameBlock& block) noexcept {
    const size_t count = static_cast<size_t>(block.frame_directional_count);
    block.frame_light_passes = std::max(1.0f, static_cast<float>(count));
    bool had_shadow = false;
    for (size_t i = 0; i < count; ++i) {
        int& splits = block.frame_directional[i].splits;
        splits = had_shadow ? 0 : splits;
        had_shadow = had_shadow || splits > 0;
    }
}

/// The greatest number of GI probes that reach one of the items.
int most_probes(std::span<const DrawItem> items) noexcept {
    int most = 0;
    for (const DrawItem& item : items) {
        most = std::max(most, probe_count(item));
    }
    return most;
}

} // namespace

int probe_count(const DrawItem& item) noexcept {
    return item.gi_probes[0] < 0 ? 0 : (item.gi_probes[1] < 0 ? 1 : 2);
}

FrameFeatures frame_features(const Frame& frame, bool has_sky) noexcept {
    FrameFeatures f;
    f.sky = has_sky;
    f.fog = frame.has_environment && frame.environment.fog_enabled;
    for (const LightItem& light : frame.lights) {
        f.directional = f.directional || light.desc->type == LightType::Directional;
        f.omni = f.omni || light.desc->type == LightType::Omni;
        f.spot = f.spot || light.desc->type == LightType::Spot;
    }
    f.omni_faces = f.omni && frame.shadow_fit == ShadowFit::ByTexel;
    f.shadow_filter = frame.shadow_filter;
    if (frame.gi_mode != GIMode::Off) {
        f.gi_probes = std::max(most_probes(frame.opaque), most_probes(frame.transparent));
        f.gi_field = frame.gi_mode == GIMode::Auto;
    }
    return f;
}

glm::vec3 light_color(const LightDesc& light) noexcept {
    const float sign = light.negative ? -1.0f : 1.0f;
    return linear_from_srgb(light.color.rgb()) * (light.energy * kPi * sign);
}

shaders::FrameBlock make_frame_block(const Frame& frame,
                                     std::span<const PlacedDirectionalShadow> shadows) noexcept {
    CL_ASSERT(shadows.size() == static_cast<size_t>(std::min(frame.directional_count, kMaxDirectionalLights)),
              "one shadow per directional light");
    FrameBlock block;
    const Transform& world_from_view = frame.camera.world_from_camera;
    block.frame_clip_from_view = projection_matrix(frame.camera, frame.size);
    block.frame_world_from_view = world_from_view.to_mat4();
    block.frame_view_from_world = world_from_view.inverse().to_mat4();
    block.frame_sky_from_view = sky_from_view(frame);
    set_environment(block, frame);
    set_fog(block, frame);
    set_cones(block, frame.quality);
    block.frame_directional_count = std::min(frame.directional_count, kMaxDirectionalLights);
    const glm::mat3 view_from_world = glm::transpose(world_from_view.basis);
    for (size_t i = 0; i < static_cast<size_t>(block.frame_directional_count); ++i) {
        const LightItem& light = frame.lights[i];
        shaders::DirectionalLight& out = block.frame_directional[i];
        out.to_light = glm::normalize(view_from_world * light.world_from_light.basis[2]);
        out.specular = light.desc->specular;
        out.color = light_color(*light.desc);
        out.shadow_color = linear_from_srgb(light.desc->shadow_color.rgb());
        out.blend_splits = light.desc->directional_blend_splits;
        set_directional_shadow(out, shadows[i], world_from_view);
    }
    block.frame_light_passes = 1.0f;
    block.frame_shadow_tap = shadow_tap_texels(frame.shadow_fit);
    if (frame.gi_mode == GIMode::Cones) {
        imitate_light_passes(block);
    }
    return block;
}

} // namespace cl::gles3
