// shaders/lib/environment_brdf.glsl -- how much of the light around a surface its gloss reflects; library
// space    none: nv = clamp(N.V, 0, 1)
// source   Lazarov 2013 as Karis fitted it for mobiles; spec gi-shading section 7, steps 1 and 4
// twin     servers/shading/brdf.h, kept equal by tests/drivers/gles3/test_shader_twins.cpp
vec3 fresnel_rough(vec3 f0, float roughness, float nv) {
    float m = 1.0 - nv;
    float m2 = m * m;
    return f0 + (max(vec3(1.0 - roughness), f0) - f0) * (m2 * m2 * m);
}

vec3 environment_brdf(vec3 fresnel, float roughness, float nv) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float k = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    vec2 e = vec2(-1.04, 1.04) * k + r.zw;
    return e.x * fresnel + e.y;
}
