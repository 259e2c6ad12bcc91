// shaders/lib/shadow.glsl -- how much of a light gets past the casters: percentage-closer filtering; library
// space    shadow map coordinates in 0..1; depths 0 at the light's near end, 1 at its far end
// needs    lib/frame_block.glsl
// output   0 in shadow, 1 lit
// source   spec scene-classes section 9 (Reeves et al. 1987); each tap is itself filtered 2x2 by the sampler
// The first tap alone, the first 5 and all 13 are the three filter modes.
const vec2 kShadowTaps[13] = vec2[13](vec2(0.0), vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0),
                                      vec2(1.0, 1.0), vec2(-1.0, 1.0), vec2(1.0, -1.0), vec2(-1.0, -1.0),
                                      vec2(2.0, 0.0), vec2(-2.0, 0.0), vec2(0.0, 2.0), vec2(0.0, -2.0));

/// Looks up `taps` places around `at`.xy, kept inside `limits` (least xy, greatest zw) so that a neighbour's map in
/// the atlas does not bleed in. taps = 0 is lit, and costs nothing.
float shadow_lookup(highp sampler2DShadow map, vec3 at, vec4 limits, vec2 texel, int taps) {
    float lit = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec2 uv = clamp(at.xy + kShadowTaps[i] * texel, limits.xy, limits.zw);
        lit += textureLod(map, vec3(uv, at.z), 0.0);
    }
    return taps > 0 ? lit / float(taps) : 1.0;
}

/// An omni light's slot holds two paraboloids, one above the other: +z below, -z above. A direction's place in it.
vec2 paraboloid_uv(vec3 direction) {
    vec2 uv = direction.xy / (1.0 + abs(direction.z)) * 0.5 + 0.5;
    return vec2(uv.x, 0.5 * uv.y + (direction.z >= 0.0 ? 0.0 : 0.5));
}

/// The direction that a place in the slot stands for; inverse of paraboloid_uv.
vec3 paraboloid_direction(vec2 uv) {
    bool upper = uv.y >= 0.5;
    vec2 p = vec2(uv.x, 2.0 * uv.y - (upper ? 1.0 : 0.0)) * 2.0 - 1.0;
    float z = 0.5 - 0.5 * dot(p, p);
    return normalize(vec3(p, upper ? -z : z));
}
