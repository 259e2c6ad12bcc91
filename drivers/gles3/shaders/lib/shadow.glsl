// shaders/lib/shadow.glsl -- how much of a light gets past the casters: percentage-closer filtering; library
// space    shadow map coordinates in 0..1; depths 0 at the light's near end, 1 at its far end
// output   0 in shadow, 1 lit
// variants PCF1, PCF13: taps of a look-up; none = 5
// source   spec scene-classes section 9 (Reeves et al. 1987); each tap is itself filtered 2x2 by the sampler
// The number of taps is a constant: unrolled, 5 of them cost llvmpipe half of what a loop over them does. Above and below
// come first: their rows of the map, which is not in the cache, are those of all the others.
#if defined(PCF1)
const int kShadowTapCount = 1;
const vec2 kShadowTaps[1] = vec2[1](vec2(0.0));
#else
#if defined(PCF13)
const int kShadowTapCount = 13;
#else
const int kShadowTapCount = 5;
#endif
const vec2 kShadowTaps[13] = vec2[13](vec2(0.0, -1.0), vec2(0.0, 1.0), vec2(0.0), vec2(1.0, 0.0), vec2(-1.0, 0.0),
                                      vec2(1.0, 1.0), vec2(-1.0, 1.0), vec2(1.0, -1.0), vec2(-1.0, -1.0),
                                      vec2(2.0, 0.0), vec2(-2.0, 0.0), vec2(0.0, 2.0), vec2(0.0, -2.0));
#endif

/// Looks up the map around `at`.xy, kept inside `limits` (least xy, greatest zw) so that a neighbour's map in the atlas
/// does not bleed in. Not `wanted` is lit, and costs nothing where no neighbouring pixel wants it either.
float shadow_lookup(highp sampler2DShadow map, vec3 at, vec4 limits, vec2 texel, bool wanted) {
    float sum = 0.0;
    int rounds = wanted ? 1 : 0; // a loop of no rounds is skipped; of a branch, both sides would be computed
    for (int k = 0; k < rounds; ++k) {
        for (int i = 0; i < kShadowTapCount; ++i) {
            vec2 uv = clamp(at.xy + kShadowTaps[i] * texel, limits.xy, limits.zw);
            sum += textureLod(map, vec3(uv, at.z), 0.0);
        }
    }
    return wanted ? sum / float(kShadowTapCount) : 1.0;
}
