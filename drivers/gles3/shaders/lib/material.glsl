// shaders/lib/material.glsl -- what a SpatialMaterial is at one fragment; library, fragment stage
// space    colours linear; the normal in view space
// needs    lib/draw_block.glsl, lib/color_space.glsl; inputs v_*
// variants ALBEDO_MAP, NORMAL_MAP, MORE_MAPS (metallic, roughness, emission, AO): a set that is too large is right
//          too, with the stand-in textures bound
// source   spec scene-classes section 15
#ifdef ALBEDO_MAP
uniform sampler2D albedo_map;
#endif
#ifdef NORMAL_MAP
uniform sampler2D normal_map;
#endif
#ifdef MORE_MAPS
uniform sampler2D metallic_map;
uniform sampler2D roughness_map;
uniform sampler2D emission_map;
uniform sampler2D ao_map;
#endif

vec2 material_uv() {
    return v_uv * draw_uv1.xy + draw_uv1.zw;
}

vec4 material_albedo() {
    vec4 albedo = draw_albedo;
#ifdef ALBEDO_MAP
    albedo *= texture(albedo_map, material_uv());
#endif
    return albedo * mix(vec4(1.0), v_color, draw_vertex_color);
}

/// The mesh's own normal, on the side that is seen.
vec3 mesh_normal() {
    return normalize(v_normal) * (gl_FrontFacing ? 1.0 : draw_back_side);
}

vec3 material_normal() {
    float side = gl_FrontFacing ? 1.0 : draw_back_side;
    vec3 normal = mesh_normal();
#ifdef NORMAL_MAP
    vec2 xy = texture(normal_map, material_uv()).xy * 2.0 - 1.0;
    float z = sqrt(max(0.0, 1.0 - dot(xy, xy)));
    vec3 mapped = normalize(v_tangent) * side * xy.x + normalize(v_binormal) * side * xy.y + normal * z;
    normal = normalize(mix(normal, mapped, draw_normal_scale));
#endif
    return normal;
}

/// Metallic and roughness.
vec2 material_gloss() {
    vec2 gloss = vec2(draw_metallic, draw_roughness);
#ifdef MORE_MAPS
    gloss.x *= dot(texture(metallic_map, material_uv()), draw_metallic_channel);
    gloss.y *= dot(texture(roughness_map, material_uv()), draw_roughness_channel);
#endif
    return gloss;
}

vec3 material_emission() {
    vec3 emission = draw_emission;
#ifdef MORE_MAPS
    vec3 texel = texture(emission_map, draw_emission_on_uv2 != 0 ? v_uv2 : material_uv()).rgb;
    emission = draw_emission_multiplies != 0 ? emission * texel : emission + texel * draw_emission_energy;
#endif
    return emission;
}

float material_ao() {
#ifdef MORE_MAPS
    return dot(texture(ao_map, draw_ao_on_uv2 != 0 ? v_uv2 : material_uv()), draw_ao_channel);
#else
    return 1.0;
#endif
}
