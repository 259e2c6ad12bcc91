// The property table of Environment: names, order and defaults of spec scene-classes section 14.1.

#include "scene/resources/environment.h"
#include "scene/resources/struct_properties.h"

#include "core/object/class_registry.h"

#include <glm/trigonometric.hpp>

#include <string>

namespace cl::scene {

namespace {

using D = EnvironmentDesc;
using E = EnvironmentEffects;
using Drawn = StructProperties<Environment, EnvironmentDesc>;
using Effects = StructProperties<Environment, EnvironmentEffects>;

glm::vec3 sky_rotation_rad(const Environment& e) {
    return euler_yxz_from_basis(e.desc().sky_orientation);
}

void set_sky_rotation_rad(Environment& e, const glm::vec3& euler_rad) {
    EnvironmentDesc desc = e.desc();
    desc.sky_orientation = basis_from_euler_yxz(euler_rad);
    e.set_desc(desc);
}

void bind_background(ClassBuilder<Environment>& c, Drawn& d, Effects& e) {
    d.choice("background_mode", &D::background_mode,
             "Clear Color,Custom Color,Sky,Color+Sky,Canvas,Keep,Camera Feed")
        .doc("What is seen where nothing is drawn.");
    c.property("background_sky", &Environment::sky, &Environment::set_sky)
        .doc("Sky for background and ambient light.");
    d.field("background_sky_custom_fov", &D::sky_custom_fov_deg)
        .range("0,180,0.1")
        .doc("Field of view of the sky [degrees]; 0: the camera's.");
    d.field("background_sky_orientation", &D::sky_orientation).doc("Turns the sky.");
    c.property("background_sky_rotation", sky_rotation_rad, set_sky_rotation_rad)
        .not_stored()
        .doc("The same as Euler angles, YXZ [rad].");
    c.property(
         "background_sky_rotation_degrees",
         [](const Environment& env) { return glm::degrees(sky_rotation_rad(env)); },
         [](Environment& env, const glm::vec3& euler_deg) {
             set_sky_rotation_rad(env, glm::radians(euler_deg));
         })
        .not_stored()
        .doc("The same as Euler angles, YXZ [degrees].");
    d.field("background_color", &D::background_color).doc("Background of the colour modes, sRGB-encoded.");
    d.field("background_energy", &D::background_energy)
        .range("0,16,0.01")
        .doc("Factor on sky and reflected background.");
    e.field("background_canvas_max_layer", &E::canvas_max_layer).doc("Stored only.");
    e.field("background_camera_feed_id", &E::camera_feed_id).doc("Stored only.");

    d.field("ambient_light_color", &D::ambient_color).doc("Ambient light, sRGB-encoded.");
    d.field("ambient_light_energy", &D::ambient_energy).range("0,16,0.01").doc("Factor on ambient light.");
    d.field("ambient_light_sky_contribution", &D::ambient_sky_contribution)
        .range("0,1,0.01")
        .doc("Share of ambient light that comes from the sky.");
}

void bind_fog(Drawn& d) {
    d.field("fog_enabled", &D::fog_enabled).doc("Fades into fog.");
    d.field("fog_color", &D::fog_color).doc("sRGB-encoded; alpha: strength of depth fog.");
    d.field("fog_sun_color", &D::fog_sun_color).doc("Stored; Godot 3.2 uses the light's colour.");
    d.field("fog_sun_amount", &D::fog_sun_amount).range("0,1,0.01").doc("Glow of the fog towards the sun.");
    d.field("fog_depth_enabled", &D::fog_depth_enabled).doc("Fog by distance.");
    d.field("fog_depth_begin", &D::fog_depth_begin_m).doc("Where it starts [m].");
    d.field("fog_depth_end", &D::fog_depth_end_m).doc("Where it is full [m]; 0: at the camera's far plane.");
    d.field("fog_depth_curve", &D::fog_depth_curve).doc("Exponent of its growth.");
    d.field("fog_transmit_enabled", &D::fog_transmit_enabled).doc("Bright things shine through.");
    d.field("fog_transmit_curve", &D::fog_transmit_curve).doc("Exponent of that.");
    d.field("fog_height_enabled", &D::fog_height_enabled).doc("Fog by height.");
    d.field("fog_height_min", &D::fog_height_min_m).doc("Height without fog [m].");
    d.field("fog_height_max", &D::fog_height_max_m).doc("Height of full fog [m].");
    d.field("fog_height_curve", &D::fog_height_curve).doc("Exponent of its growth.");
}

void bind_tonemap_and_exposure(Drawn& d, Effects& e) {
    d.choice("tonemap_mode", &D::tone_mapper, "Linear,Reinhard,Filmic,Aces").doc("Tone mapping curve.");
    d.field("tonemap_exposure", &D::exposure).range("0,16,0.01").doc("Factor before the curve.");
    d.field("tonemap_white", &D::white)
        .range("0,16,0.01")
        .doc("Radiance that becomes white; not used by Linear.");
    e.field("auto_exposure_enabled", &E::auto_exposure).doc("Stored only.");
    e.field("auto_exposure_scale", &E::auto_exposure_scale).doc("Stored only.");
    e.field("auto_exposure_min_luma", &E::auto_exposure_min_luma).doc("Stored only.");
    e.field("auto_exposure_max_luma", &E::auto_exposure_max_luma).doc("Stored only.");
    e.field("auto_exposure_speed", &E::auto_exposure_speed).doc("Stored only.");
}

void bind_screen_space(Effects& e) {
    e.field("ss_reflections_enabled", &E::ssr).doc("Stored only.");
    e.field("ss_reflections_max_steps", &E::ssr_max_steps).doc("Stored only.");
    e.field("ss_reflections_fade_in", &E::ssr_fade_in).doc("Stored only.");
    e.field("ss_reflections_fade_out", &E::ssr_fade_out).doc("Stored only.");
    e.field("ss_reflections_depth_tolerance", &E::ssr_depth_tolerance).doc("Stored only.");
    e.field("ss_reflections_roughness", &E::ssr_roughness).doc("Stored only.");
    e.field("ssao_enabled", &E::ssao).doc("Stored only.");
    e.field("ssao_radius", &E::ssao_radius).doc("Stored only.");
    e.field("ssao_intensity", &E::ssao_intensity).doc("Stored only.");
    e.field("ssao_radius2", &E::ssao_radius2).doc("Stored only.");
    e.field("ssao_intensity2", &E::ssao_intensity2).doc("Stored only.");
    e.field("ssao_bias", &E::ssao_bias).doc("Stored only.");
    e.field("ssao_light_affect", &E::ssao_light_affect).doc("Stored only.");
    e.field("ssao_ao_channel_affect", &E::ssao_ao_channel_affect).doc("Stored only.");
    e.field("ssao_color", &E::ssao_color).doc("Stored only.");
    e.choice("ssao_quality", &E::ssao_quality, "Low,Medium,High").doc("Stored only.");
    e.choice("ssao_blur", &E::ssao_blur, "Disabled,1x1,2x2,3x3").doc("Stored only.");
    e.field("ssao_edge_sharpness", &E::ssao_edge_sharpness).doc("Stored only.");
}

void bind_blur_and_glow(ClassBuilder<Environment>& c, Effects& e) {
    e.field("dof_blur_far_enabled", &E::dof_far).doc("Stored only.");
    e.field("dof_blur_far_distance", &E::dof_far_distance).doc("Stored only.");
    e.field("dof_blur_far_transition", &E::dof_far_transition).doc("Stored only.");
    e.field("dof_blur_far_amount", &E::dof_far_amount).doc("Stored only.");
    e.choice("dof_blur_far_quality", &E::dof_far_quality, "Low,Medium,High").doc("Stored only.");
    e.field("dof_blur_near_enabled", &E::dof_near).doc("Stored only.");
    e.field("dof_blur_near_distance", &E::dof_near_distance).doc("Stored only.");
    e.field("dof_blur_near_transition", &E::dof_near_transition).doc("Stored only.");
    e.field("dof_blur_near_amount", &E::dof_near_amount).doc("Stored only.");
    e.choice("dof_blur_near_quality", &E::dof_near_quality, "Low,Medium,High").doc("Stored only.");

    e.field("glow_enabled", &E::glow).doc("Stored only.");
    for (size_t level = 0; level < EnvironmentEffects{}.glow_levels.size(); ++level) {
        c.property(
             "glow_levels/" + std::to_string(level + 1),
             [level](const Environment& env) -> bool { return env.effects().glow_levels[level]; },
             [level](Environment& env, bool on) {
                 EnvironmentEffects effects = env.effects();
                 effects.glow_levels[level] = on;
                 env.set_effects(effects);
             })
            .doc("Stored only.");
    }
    e.field("glow_intensity", &E::glow_intensity).doc("Stored only.");
    e.field("glow_strength", &E::glow_strength).doc("Stored only.");
    e.field("glow_bloom", &E::glow_bloom).doc("Stored only.");
    e.choice("glow_blend_mode", &E::glow_blend_mode, "Additive,Screen,Softlight,Replace").doc("Stored only.");
    e.field("glow_hdr_threshold", &E::glow_hdr_threshold).doc("Stored only.");
    e.field("glow_hdr_luminance_cap", &E::glow_hdr_luminance_cap).doc("Stored only.");
    e.field("glow_hdr_scale", &E::glow_hdr_scale).doc("Stored only.");
    e.field("glow_bicubic_upscale", &E::glow_bicubic_upscale).doc("Stored only.");
}

} // namespace

void Environment::bind(ClassBuilder<Environment>& c) {
    c.doc("Background, ambient light, fog and tone mapping of a world or a camera.");
    Drawn d(c, &Environment::desc, &Environment::set_desc);
    Effects e(c, &Environment::effects, &Environment::set_effects);
    bind_background(c, d, e);
    bind_fog(d);
    bind_tonemap_and_exposure(d, e);
    bind_screen_space(e);
    bind_blur_and_glow(c, e);
    d.field("adjustment_enabled", &D::adjustment_enabled).doc("Adjusts the finished picture.");
    d.field("adjustment_brightness", &D::brightness).range("0.01,8,0.01").doc("Factor on encoded colour.");
    d.field("adjustment_contrast", &D::contrast).range("0.01,8,0.01").doc("Distance from grey.");
    d.field("adjustment_saturation", &D::saturation)
        .range("0.01,8,0.01")
        .doc("Distance from the mean of the channels.");
    c.property("adjustment_color_correction", &Environment::color_correction,
               &Environment::set_color_correction)
        .doc("Stored only.");
}

} // namespace cl::scene
