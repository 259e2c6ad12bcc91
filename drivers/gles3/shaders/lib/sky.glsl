// shaders/lib/sky.glsl -- look-ups into a sky's maps; library, no main()
// space    directions in the sky maps' space: world, turned by the inverse of the sky's orientation, z mirrored
// maps     filtered: dual paraboloids, a layer a roughness (0, 0.2 .. 1), seen as a 3D texture; irradiance: one;
//          drivers/gles3/sky_filter.h says how they are made
// source   spec scene-classes section 14.4
vec2 sky_map_uv(vec3 direction) {
    vec2 p = direction.xy / (1.0 + abs(direction.z));
    vec2 uv = vec2(p.x * 0.5 + 0.5, p.y * 0.25 + 0.25);
    return direction.z >= 0.0 ? uv : vec2(uv.x, 1.0 - uv.y);
}

vec3 sky_irradiance(sampler2D map, vec3 normal) {
    return textureLod(map, sky_map_uv(normal), 0.0).rgb;
}

vec3 sky_radiance(sampler3D map, vec3 direction, float roughness) {
    float layer = clamp(roughness, 0.0, 1.0) * 5.0;
    return textureLod(map, vec3(sky_map_uv(direction), (layer + 0.5) / 6.0), 0.0).rgb;
}

/// Where a direction lies in the panorama (x wraps). In world space turned by the sky's orientation, not mirrored.
vec2 panorama_uv(vec3 direction) {
    float u = atan(direction.x, -direction.z) / (2.0 * 3.14159265359);
    float v = acos(clamp(direction.y, -1.0, 1.0)) / 3.14159265359;
    return vec2(u < 0.0 ? u + 1.0 : u, v);
}
