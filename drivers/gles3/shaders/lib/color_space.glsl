// shaders/lib/color_space.glsl -- sRGB curve, both ways; library, no main()
// space    rgb in [0, 1] encoded, not clamped linear; alpha is never converted
// source   IEC 61966-2-1 with the thresholds of spec scene-classes sections 14.9 and 21
// twin     core/math/color.h, kept equal by tests/drivers/gles3/test_shader_twins.cpp
vec3 srgb_from_linear(vec3 c) {
    vec3 low = 12.92 * c;
    vec3 high = 1.055 * pow(max(c, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThan(c, vec3(0.0031308)));
}

vec3 linear_from_srgb(vec3 c) {
    vec3 low = c / 12.92;
    vec3 high = pow((max(c, vec3(0.0)) + 0.055) / 1.055, vec3(2.4));
    return mix(high, low, lessThan(c, vec3(0.04045)));
}
