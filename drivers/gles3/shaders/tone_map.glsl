// tone_map.glsl -- scene radiance to the picture: exposure, tone mapper, sRGB, adjustments, 8 bits
// output   sRGB-encoded, quantised downwards to n / 255 from halves (spec scene-classes section 14.11), so that the
//          target's own rounding keeps the value
#pragma flags REINHARD FILMIC ACES ADJUST
#pragma validate
#pragma validate REINHARD
#pragma validate FILMIC ADJUST
#pragma validate ACES

#pragma stage vertex
#include "lib/fullscreen.glsl"
void main() {
    fullscreen_position();
}

#pragma stage fragment
#include "lib/color_space.glsl"
#include "lib/tone_map.glsl"
layout(location = 0) out vec4 out_color;
uniform sampler2D radiance;
uniform float exposure;
uniform float white;
uniform vec3 brightness_contrast_saturation;

#if defined(REINHARD)
const int kMode = 1;
#elif defined(FILMIC)
const int kMode = 2;
#elif defined(ACES)
const int kMode = 3;
#else
const int kMode = 0;
#endif

/// Towards zero, as llvmpipe stores halves: Godot's pictures were made with that.
vec3 truncated_to_half(vec3 v) {
    return uintBitsToFloat(floatBitsToUint(v) & 0xFFFFE000u);
}

void main() {
    vec3 color = texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb * exposure;
    vec3 encoded = srgb_from_linear(tone_map(color, kMode, white));
#ifdef ADJUST
    encoded = clamp(adjust(encoded, brightness_contrast_saturation), 0.0, 1.0);
#endif
    out_color = vec4(floor(truncated_to_half(encoded) * 255.0) / 255.0, 1.0);
}
