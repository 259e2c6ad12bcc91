// scene.glsl -- forward shading of one surface: all its lights, ambient light or GI, emission, fog
// output   linear radiance [W m^-2 sr^-1], straight alpha; before exposure and tone mapping
// source   spec gi-shading section 7 (composition), scene-classes sections 8 and 14.3
#pragma flags ALBEDO_MAP NORMAL_MAP MORE_MAPS ALPHA_SCISSOR UNSHADED GI_ONE GI_TWO GI_FIELD GI_AIR GI_GLOSS GI_GATHERED SKY FOG DIRECTIONAL OMNI OMNI_FACES SPOT PCF1 PCF13 DIFFUSE_LAMBERT DIFFUSE_WRAP DIFFUSE_OREN_NAYAR DIFFUSE_TOON SPECULAR_BLINN SPECULAR_PHONG SPECULAR_TOON SPECULAR_DISABLED
#pragma validate
#pragma validate UNSHADED ALBEDO_MAP ALPHA_SCISSOR
#pragma validate ALBEDO_MAP NORMAL_MAP MORE_MAPS ALPHA_SCISSOR GI_TWO SKY FOG DIRECTIONAL OMNI SPOT
#pragma validate GI_ONE DIRECTIONAL OMNI SPOT DIFFUSE_LAMBERT SPECULAR_DISABLED
#pragma validate GI_TWO GI_FIELD SKY OMNI OMNI_FACES
#pragma validate GI_ONE GI_FIELD GI_AIR DIRECTIONAL
#pragma validate GI_TWO GI_FIELD GI_GLOSS ALBEDO_MAP NORMAL_MAP MORE_MAPS SKY DIRECTIONAL OMNI OMNI_FACES SPOT
#pragma validate GI_GATHERED OMNI
#pragma validate SKY OMNI PCF1 DIFFUSE_WRAP SPECULAR_BLINN
#pragma validate FOG SPOT PCF13 DIFFUSE_OREN_NAYAR SPECULAR_PHONG
#pragma validate DIRECTIONAL DIFFUSE_TOON SPECULAR_TOON
#pragma share cone_light field_light

#include "lib/frame_block.glsl"
#include "lib/draw_block.glsl"

#pragma stage vertex
#include "lib/vertex_inputs.glsl"
#include "lib/scene_vertex.glsl"
#include "lib/color_space.glsl"
#include "lib/surface_vertex.glsl"

void main() {
    // Once a vertex, as Godot does: mixed as light is, not as codes are.
    surface_vertex(vec4(mix(a_color.rgb, linear_from_srgb(a_color.rgb), draw_vertex_color_srgb), a_color.a));
}

#pragma stage fragment
#include "lib/surface_inputs.glsl"
layout(location = 0) out vec4 out_color;

#include "lib/color_space.glsl"
#include "lib/material.glsl"

uniform sampler2DShadow shadow_atlas;
uniform sampler2DShadow directional_shadow;
uniform sampler2D sky_irradiance_map;
uniform sampler3D sky_radiance_map;
uniform sampler3D gi_volume_1;
uniform sampler3D gi_volume_2;
#ifdef GI_GATHERED
uniform sampler2D cone_light; // by pixel: diffuse below, specular above; a: share of what is beyond the probes
#endif

#include "lib/light_set_block.glsl"
#include "lib/brdf.glsl"
#include "lib/environment_brdf.glsl"
#include "lib/shadow.glsl"
#include "lib/paraboloid.glsl"
#include "lib/omni_faces.glsl"
#include "lib/lights.glsl"
#include "lib/cone_trace.glsl"
#include "lib/gi_probe.glsl"
#include "lib/gi_field.glsl"
#include "lib/sky.glsl"
#include "lib/fog.glsl"

#ifdef UNSHADED
void main() {
    vec4 albedo = material_albedo();
#ifdef ALPHA_SCISSOR
    if (albedo.a < draw_alpha_scissor) {
        discard;
    }
#endif
    out_color = vec4(albedo.rgb, draw_uses_alpha != 0 ? albedo.a : 1.0);
}
#else
/// Light from all around, before GI (scene-classes section 14.3): diffuse, and towards the mirror direction.
void ambient_light(Surface s, vec3 reflection, vec3 fresnel, out vec3 ambient, out vec3 environment) {
#ifdef SKY
    mat3 sky_from_view = mat3(frame_sky_from_view);
    float energy = frame_background_energy;
    environment = sky_radiance(sky_radiance_map, sky_from_view * reflection, s.roughness) * energy;
    vec3 irradiance = sky_irradiance(sky_irradiance_map, sky_from_view * s.normal) * energy * (1.0 - fresnel);
    ambient = mix(frame_ambient_color, irradiance, frame_sky_contribution) * frame_ambient_energy;
#else
    environment = frame_environment;
    ambient = frame_ambient_color * frame_ambient_energy;
#endif
    ambient *= draw_receives_ambient * (draw_gi_count == 0 ? frame_light_passes : 1.0);
    environment *= draw_receives_ambient;
}

void gather_gi(Surface s, vec3 reflection, inout vec3 ambient, inout vec3 environment) {
#ifdef GI_FIELD
    FieldPoint at = FieldPoint(s.position, mesh_normal(), s.normal, reflection, s.roughness, environment);
    FieldSum sum = FieldSum(vec3(0.0), vec3(0.0), 0.0);
    add_gi_field(gi_volume_1, draw_gi[0], at, sum);
#ifdef GI_TWO
    add_gi_field(gi_volume_2, draw_gi[1], at, sum);
#endif
    ambient = sum.diffuse + ambient * (1.0 - sum.share);
    environment = sum.specular + environment * (1.0 - sum.share);
#elif defined(GI_GATHERED)
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 diffuse = texelFetch(cone_light, pixel, 0);
    vec4 specular = texelFetch(cone_light, pixel + ivec2(0, textureSize(cone_light, 0).y / 2), 0);
    ambient = draw_gi_count > 0 ? diffuse.rgb + ambient * diffuse.a : ambient;
    environment = draw_gi_count > 0 ? specular.rgb + environment * specular.a : environment;
#elif defined(GI_ONE) || defined(GI_TWO)
    GIPoint at = GIPoint(s.position, s.normal, reflection, s.roughness, ambient, environment);
    GISum sum = GISum(vec4(0.0), vec4(0.0));
    add_gi_probe(gi_volume_1, draw_gi[0], at, sum);
#ifdef GI_TWO
    add_gi_probe(gi_volume_2, draw_gi[1], at, sum);
#endif
    resolve_gi(sum, ambient, environment);
#endif
}

LightSum direct_light(Surface s) {
    LightSum sum = LightSum(vec3(0.0), vec3(0.0));
    bool shadows_on = draw_receives_shadows != 0;
#ifdef DIRECTIONAL
    add_directional_lights(s, shadows_on, sum);
#endif
#ifdef OMNI
    add_omni_lights(s, shadows_on, sum);
#endif
#ifdef SPOT
    add_spot_lights(s, shadows_on, sum);
#endif
    return sum;
}

void main() {
    vec4 albedo = material_albedo();
#ifdef ALPHA_SCISSOR
    if (albedo.a < draw_alpha_scissor) {
        discard;
    }
#endif
    vec2 gloss = material_gloss();
    Surface s;
    s.position = v_position;
    s.mesh_normal = mesh_normal();
    s.normal = material_normal();
    s.to_eye = -normalize(v_position);
    s.albedo = albedo.rgb;
    s.metallic = gloss.x;
    s.roughness = gloss.y;
    s.specular = draw_specular;
    s.f0 = f0_from_material(s.albedo, s.metallic, s.specular);

    float nv = clamp(dot(s.normal, s.to_eye), 0.0, 1.0);
    vec3 fresnel = fresnel_rough(s.f0, s.roughness, nv);
    vec3 reflection = reflect(-s.to_eye, s.normal);
    vec3 ambient;
    vec3 environment;
    ambient_light(s, reflection, fresnel, ambient, environment);
    gather_gi(s, reflection, ambient, environment);
#ifdef DIFFUSE_TOON
    vec3 specular = environment * 2.0 * s.specular * s.metallic * s.albedo;
#else
    vec3 reflected = environment_brdf(fresnel, s.roughness, nv);
    vec3 specular = environment * reflected;
#ifdef GI_FIELD
    ambient *= max(1.0 - reflected, 0.0); // no light twice; the fit exceeds 1 at grazing angles
#endif
#endif

    LightSum direct = direct_light(s);
    float ao = material_ao();
    float ao_direct = mix(1.0, ao, draw_ao_light_affect);
    vec3 diffuse = (direct.diffuse * ao_direct + ambient * s.albedo * ao) * (1.0 - s.metallic);
    vec3 lit = diffuse + (specular + direct.specular) * ao_direct;
    vec3 emission = material_emission() * frame_light_passes;
#ifdef FOG
    vec4 fog = fog_at(s.position, lit + emission);
    lit = mix(lit, vec3(0.0), fog.a);
    emission = mix(emission, fog.rgb, fog.a);
#endif
    out_color = vec4(emission + lit, draw_uses_alpha != 0 ? albedo.a : 1.0);
}
#endif
