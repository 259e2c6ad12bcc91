// shaders/lib/tone_map.glsl -- tone mappers and picture adjustments; library, no main()
// space    tone mappers: linear radiance after exposure in, linear [0, 1] out; adjustments: sRGB-encoded
// inputs   mode 0 linear, 1 Reinhard, 2 Filmic, 3 ACES; white: the radiance that maps to 1 (unused by linear)
// source   spec scene-classes sections 14.9 and 14.10 (Hable 2010, Narkowicz 2015)
// twin     servers/shading/tone_map.h, kept equal by tests/drivers/gles3/test_shader_twins.cpp
vec3 filmic_curve(vec3 x) {
    const float a = 0.88, b = 0.6, c = 0.1, d = 0.2, e = 0.01, f = 0.3;
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

vec3 aces_curve(vec3 x) {
    const float a = 2.51 * 0.85 * 0.85, b = 0.03 * 0.85, c = 2.43 * 0.85 * 0.85, d = 0.59 * 0.85, e = 0.14;
    return x * (a * x + b) / (x * (c * x + d) + e);
}

vec3 tone_map(vec3 color, int mode, float white) {
    vec3 w = vec3(white);
    if (mode == 1) {
        color = clamp((white * color + color) / (color * white + white), 0.0, 1.0);
    } else if (mode == 2) {
        color = clamp(filmic_curve(color) / filmic_curve(w), 0.0, 1.0);
    } else if (mode == 3) {
        color = clamp(aces_curve(color) / aces_curve(w), 0.0, 1.0);
    }
    return clamp(color, 0.0, 1.0);
}

/// `bcs`: brightness, contrast, saturation; all 1 changes nothing.
vec3 adjust(vec3 encoded, vec3 bcs) {
    encoded = mix(vec3(0.0), encoded, bcs.x);
    encoded = mix(vec3(0.5), encoded, bcs.y);
    return mix(vec3(dot(vec3(1.0), encoded) * 0.33333), encoded, bcs.z);
}
