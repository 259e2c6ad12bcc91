// The property table of SpatialMaterial: names, order and defaults of spec scene-classes section 15.

#include "scene/resources/spatial_material.h"
#include "scene/resources/struct_properties.h"

#include "core/object/class_registry.h"

namespace cl::scene {

namespace {

using P = SpatialParams;
using Properties = StructProperties<SpatialMaterial, SpatialParams>;
using Builder = ClassBuilder<SpatialMaterial>;
using Property = PropertyBuilder<SpatialMaterial>;

constexpr const char* kChannels = "Red,Green,Blue,Alpha,Gray";

/// Saved whenever `condition` holds, even at its default, and never otherwise (spec section 15).
template <typename Condition>
Property only_if(Property property, Condition condition) {
    return property.stored_if(condition).always_stored();
}

/// The same for a switch of the material.
Property only_with(Property property, bool P::*feature) {
    return only_if(property, [feature](const SpatialMaterial& m) { return m.params().*feature; });
}

Property texture(Builder& c, std::string_view name, TextureSlot slot) {
    return c.property(
        name, [slot](const SpatialMaterial& m) { return m.texture(slot); },
        [slot](SpatialMaterial& m, Ref<Texture> t) { m.set_texture(slot, std::move(t)); });
}

void bind_flags(Properties& p) {
    p.field("flags_transparent", &P::transparent).doc("Blends by alpha, in the sorted pass.");
    p.field("flags_use_shadow_to_opacity", &P::shadow_to_opacity).doc("Opacity from shadow; stored only.");
    p.field("flags_unshaded", &P::unshaded).doc("Shows albedo alone, without light.");
    p.field("flags_vertex_lighting", &P::vertex_lighting).doc("Lights evaluated at vertices.");
    p.field("flags_no_depth_test", &P::no_depth_test).doc("Drawn over everything, in the sorted pass.");
    p.field("flags_use_point_size", &P::use_point_size).doc("Points have params_point_size; stored only.");
    p.field("flags_world_triplanar", &P::world_triplanar).doc("Triplanar mapping in world space.");
    p.field("flags_fixed_size", &P::fixed_size).doc("Same size at any distance; stored only.");
    p.field("flags_albedo_tex_force_srgb", &P::albedo_tex_force_srgb)
        .doc("Decodes the albedo texture once more.");
    p.field("flags_do_not_receive_shadows", &P::do_not_receive_shadows).doc("Lit even where in shadow.");
    p.field("flags_disable_ambient_light", &P::disable_ambient_light)
        .doc("No ambient light and reflections.");
    p.field("flags_ensure_correct_normals", &P::ensure_correct_normals)
        .doc("Normals by the inverse transpose: right under uneven scale.");
    p.field("vertex_color_use_as_albedo", &P::vertex_color_use_as_albedo)
        .doc("Vertex colour multiplies albedo.");
    p.field("vertex_color_is_srgb", &P::vertex_color_is_srgb).doc("Vertex colours are sRGB-encoded.");
}

void bind_params(Properties& p) {
    p.choice("params_diffuse_mode", &P::diffuse_mode, "Burley,Lambert,Lambert Wrap,Oren Nayar,Toon")
        .doc("Diffuse BRDF.");
    p.choice("params_specular_mode", &P::specular_mode, "SchlickGGX,Blinn,Phong,Toon,Disabled")
        .doc("Specular BRDF of direct light.");
    p.choice("params_blend_mode", &P::blend_mode, "Mix,Add,Sub,Mul").doc("Blending with what lies behind.");
    p.choice("params_cull_mode", &P::cull_mode, "Back,Front,Disabled").doc("Faces not drawn.");
    p.choice("params_depth_draw_mode", &P::depth_draw_mode, "Opaque Only,Always,Never,Opaque Pre-Pass")
        .doc("When depth is written.");
    p.field("params_line_width", &P::line_width).range("0.1,128,0.1").doc("Stored only.");
    p.field("params_point_size", &P::point_size).range("0.1,128,0.1").doc("Stored only.");
    p.choice("params_billboard_mode", &P::billboard_mode, "Disabled,Enabled,Y-Billboard,Particle Billboard")
        .doc("Turns towards the camera; stored only.");
    p.field("params_billboard_keep_scale", &P::billboard_keep_scale).doc("Stored only.");
    p.field("params_grow", &P::grow).doc("Moves vertices along their normals.");
    only_with(p.field("params_grow_amount", &P::grow_amount_m), &P::grow)
        .range("-16,16,0.01")
        .doc("By how far [m].");
    p.field("params_use_alpha_scissor", &P::use_alpha_scissor).doc("Cuts out by alpha instead of blending.");
    only_with(p.field("params_alpha_scissor_threshold", &P::alpha_scissor_threshold), &P::use_alpha_scissor)
        .range("0,1,0.01")
        .doc("Alpha below this is not drawn.");
    const auto particles = [](const SpatialMaterial& m) {
        return m.params().billboard_mode == BillboardMode::Particles;
    };
    only_if(p.field("particles_anim_h_frames", &P::particles_anim_h_frames), particles).doc("Stored only.");
    only_if(p.field("particles_anim_v_frames", &P::particles_anim_v_frames), particles).doc("Stored only.");
    only_if(p.field("particles_anim_loop", &P::particles_anim_loop), particles).doc("Stored only.");
}

void bind_surface(Builder& c, Properties& p) {
    p.field("albedo_color", &P::albedo).doc("Base colour, sRGB-encoded.");
    texture(c, "albedo_texture", TextureSlot::Albedo).doc("Multiplies albedo_color; decoded from sRGB.");
    p.field("metallic", &P::metallic).range("0,1,0.01").doc("0: dielectric, 1: metal.");
    p.field("metallic_specular", &P::specular)
        .range("0,1,0.01")
        .doc("Reflectance of a dielectric; 0.5 is 4 %.");
    texture(c, "metallic_texture", TextureSlot::Metallic).doc("Multiplies metallic.");
    p.choice("metallic_texture_channel", &P::metallic_channel, kChannels).doc("Channel of metallic_texture.");
    p.field("roughness", &P::roughness).range("0,1,0.01").doc("0: mirror, 1: matte.");
    texture(c, "roughness_texture", TextureSlot::Roughness).doc("Multiplies roughness.");
    p.choice("roughness_texture_channel", &P::roughness_channel, kChannels)
        .doc("Channel of roughness_texture.");

    p.field("emission_enabled", &P::emission_enabled).doc("Emits light.");
    const auto emission = &P::emission_enabled;
    only_with(p.field("emission", &P::emission), emission).doc("Colour of the emission, sRGB-encoded.");
    only_with(p.field("emission_energy", &P::emission_energy), emission)
        .range("0,16,0.01")
        .doc("Factor on it.");
    only_with(p.choice("emission_operator", &P::emission_operator, "Add,Multiply"), emission)
        .doc("How colour and texture combine.");
    only_with(p.field("emission_on_uv2", &P::emission_on_uv2), emission).doc("Texture by the second UVs.");
    only_with(texture(c, "emission_texture", TextureSlot::Emission), emission).doc("Decoded from sRGB.");

    p.field("normal_enabled", &P::normal_enabled).doc("Bends normals by a map.");
    const auto normal = &P::normal_enabled;
    only_with(p.field("normal_scale", &P::normal_scale), normal)
        .range("-16,16,0.01")
        .doc("Strength of the map.");
    only_with(texture(c, "normal_texture", TextureSlot::Normal), normal).doc("Tangent space normals, y up.");
}

void bind_coatings(Builder& c, Properties& p) {
    p.field("rim_enabled", &P::rim_enabled).doc("Brightens edges; stored only.");
    const auto rim = &P::rim_enabled;
    only_with(p.field("rim", &P::rim), rim).range("0,1,0.01").doc("Stored only.");
    only_with(p.field("rim_tint", &P::rim_tint), rim).range("0,1,0.01").doc("Stored only.");
    only_with(texture(c, "rim_texture", TextureSlot::Rim), rim).doc("Stored only.");

    p.field("clearcoat_enabled", &P::clearcoat_enabled).doc("A thin gloss above; stored only.");
    const auto coat = &P::clearcoat_enabled;
    only_with(p.field("clearcoat", &P::clearcoat), coat).range("0,1,0.01").doc("Stored only.");
    only_with(p.field("clearcoat_gloss", &P::clearcoat_gloss), coat).range("0,1,0.01").doc("Stored only.");
    only_with(texture(c, "clearcoat_texture", TextureSlot::Clearcoat), coat).doc("Stored only.");

    p.field("anisotropy_enabled", &P::anisotropy_enabled).doc("Stretches highlights; stored only.");
    const auto anisotropy = &P::anisotropy_enabled;
    only_with(p.field("anisotropy", &P::anisotropy), anisotropy).range("-1,1,0.01").doc("Stored only.");
    only_with(texture(c, "anisotropy_flowmap", TextureSlot::AnisotropyFlow), anisotropy).doc("Stored only.");

    p.field("ao_enabled", &P::ao_enabled).doc("Darkens by an occlusion map.");
    const auto ao = &P::ao_enabled;
    only_with(p.field("ao_light_affect", &P::ao_light_affect), ao)
        .range("0,1,0.01")
        .doc("Share of it on direct light.");
    only_with(texture(c, "ao_texture", TextureSlot::AmbientOcclusion), ao).doc("1: open, 0: occluded.");
    only_with(p.field("ao_on_uv2", &P::ao_on_uv2), ao).doc("Texture by the second UVs.");
    only_with(p.choice("ao_texture_channel", &P::ao_channel, kChannels), ao).doc("Channel of ao_texture.");
}

void bind_depth_and_volume(Builder& c, Properties& p) {
    p.field("depth_enabled", &P::depth_enabled).doc("Parallax by a height map; stored only.");
    const auto depth = &P::depth_enabled;
    const auto deep = [](const SpatialMaterial& m) {
        return m.params().depth_enabled && m.params().depth_deep_parallax;
    };
    only_with(p.field("depth_scale", &P::depth_scale), depth).range("-16,16,0.01").doc("Stored only.");
    only_with(p.field("depth_deep_parallax", &P::depth_deep_parallax), depth).doc("Stored only.");
    only_if(p.field("depth_min_layers", &P::depth_min_layers), deep).range("1,32,1").doc("Stored only.");
    only_if(p.field("depth_max_layers", &P::depth_max_layers), deep).range("1,32,1").doc("Stored only.");
    only_with(p.field("depth_flip_tangent", &P::depth_flip_tangent), depth).doc("Stored only.");
    only_with(p.field("depth_flip_binormal", &P::depth_flip_binormal), depth).doc("Stored only.");
    only_with(texture(c, "depth_texture", TextureSlot::Depth), depth).doc("Stored only.");

    p.field("subsurf_scatter_enabled", &P::subsurf_scatter_enabled).doc("Light spreads below; stored only.");
    const auto sss = &P::subsurf_scatter_enabled;
    only_with(p.field("subsurf_scatter_strength", &P::subsurf_scatter_strength), sss)
        .range("0,1,0.01")
        .doc("Stored only.");
    only_with(texture(c, "subsurf_scatter_texture", TextureSlot::SubsurfaceScattering), sss)
        .doc("Stored only.");

    p.field("transmission_enabled", &P::transmission_enabled).doc("Light shines through; stored only.");
    const auto transmission = &P::transmission_enabled;
    only_with(p.field("transmission", &P::transmission), transmission)
        .doc("Colour, sRGB-encoded; stored only.");
    only_with(texture(c, "transmission_texture", TextureSlot::Transmission), transmission)
        .doc("Stored only.");

    p.field("refraction_enabled", &P::refraction_enabled).doc("Bends what lies behind; stored only.");
    const auto refraction = &P::refraction_enabled;
    only_with(p.field("refraction_scale", &P::refraction_scale), refraction)
        .range("-1,1,0.01")
        .doc("Stored only.");
    only_with(texture(c, "refraction_texture", TextureSlot::Refraction), refraction).doc("Stored only.");
    only_with(p.choice("refraction_texture_channel", &P::refraction_channel, kChannels), refraction)
        .doc("Stored only.");

    p.field("detail_enabled", &P::detail_enabled).doc("A second layer of textures; stored only.");
    const auto detail = &P::detail_enabled;
    only_with(texture(c, "detail_mask", TextureSlot::DetailMask), detail).doc("Stored only.");
    only_with(p.choice("detail_blend_mode", &P::detail_blend_mode, "Mix,Add,Sub,Mul"), detail)
        .doc("Stored only.");
    only_with(p.choice("detail_uv_layer", &P::detail_uv_layer, "UV1,UV2"), detail).doc("Stored only.");
    only_with(texture(c, "detail_albedo", TextureSlot::DetailAlbedo), detail).doc("Stored only.");
    only_with(texture(c, "detail_normal", TextureSlot::DetailNormal), detail).doc("Stored only.");
}

void bind_uv_and_fades(Properties& p) {
    p.field("uv1_scale", &P::uv1_scale).doc("UV = mesh UV * scale + offset.");
    p.field("uv1_offset", &P::uv1_offset).doc("UV = mesh UV * scale + offset.");
    p.field("uv1_triplanar", &P::uv1_triplanar).doc("Textures from three sides by position.");
    p.field("uv1_triplanar_sharpness", &P::uv1_triplanar_sharpness)
        .doc("Exponent of the blend between the sides.");
    p.field("uv2_scale", &P::uv2_scale).doc("The same for the second UVs.");
    p.field("uv2_offset", &P::uv2_offset).doc("The same for the second UVs.");
    p.field("uv2_triplanar", &P::uv2_triplanar).doc("Stored only.");
    p.field("uv2_triplanar_sharpness", &P::uv2_triplanar_sharpness).doc("Stored only.");

    p.field("proximity_fade_enable", &P::proximity_fade).doc("Fades near other surfaces; stored only.");
    only_with(p.field("proximity_fade_distance", &P::proximity_fade_distance_m), &P::proximity_fade)
        .doc("Stored only.");
    p.choice("distance_fade_mode", &P::distance_fade_mode, "Disabled,PixelAlpha,PixelDither,ObjectDither")
        .doc("Fades with distance; stored only.");
    const auto fades = [](const SpatialMaterial& m) {
        return m.params().distance_fade_mode != DistanceFadeMode::Disabled;
    };
    only_if(p.field("distance_fade_min_distance", &P::distance_fade_min_m), fades).doc("[m]; stored only.");
    only_if(p.field("distance_fade_max_distance", &P::distance_fade_max_m), fades).doc("[m]; stored only.");
}

} // namespace

void SpatialMaterial::bind(ClassBuilder<SpatialMaterial>& c) {
    c.doc("The standard surface: metallic-roughness with optional features.");
    Properties p(c, &SpatialMaterial::params, &SpatialMaterial::set_params);
    bind_flags(p);
    bind_params(p);
    bind_surface(c, p);
    bind_coatings(c, p);
    bind_depth_and_volume(c, p);
    bind_uv_and_fades(p);
}

} // namespace cl::scene
