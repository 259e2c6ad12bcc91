// shaders/lib/brdf.glsl -- reflection of one light, by material mode; library, no main()
// space    any one space for all vectors, unit length; colours linear
// inputs   cosines: nl = N.L (signed), nv = max(N.V, 0), lh = max(L.H, 0), nh = max(N.H, 0), H = normalize(V + L)
// output   diffuse terms include the cosine; times light * albedo gives outgoing radiance. A light of energy 1 is
//          pi, so a white Lambert surface that faces it has radiance 1
// source   spec scene-classes section 8 (Burley 2012, Oren & Nayar 1994 in Fujii's form, Walter et al. 2007)
// twin     servers/shading/brdf.h, kept equal by tests/drivers/gles3/test_shader_twins.cpp
const float kPi = 3.14159265359;

float schlick_weight(float cosine) {
    float m = clamp(1.0 - cosine, 0.0, 1.0);
    float m2 = m * m;
    return m2 * m2 * m;
}

float diffuse_burley(float nl, float nv, float lh, float roughness) {
    float cl = max(nl, 0.0);
    float f = 2.0 * lh * lh * roughness - 0.5;
    return (1.0 + f * schlick_weight(nv)) * (1.0 + f * schlick_weight(cl)) * cl / kPi;
}

float diffuse_lambert(float nl) {
    return max(nl, 0.0) / kPi;
}

float diffuse_lambert_wrap(float nl, float roughness) {
    float w = 1.0 + roughness;
    return max(0.0, (nl + roughness) / (w * w));
}

/// `lv` = L.V, `nv_signed` = N.V before clamping.
vec3 diffuse_oren_nayar(float nl, float nv_signed, float lv, float roughness, vec3 albedo) {
    float s = lv - nl * nv_signed;
    float t = s < 0.0 ? 1.0 : max(nl, nv_signed);
    float sigma2 = roughness * roughness;
    vec3 a = 1.0 + sigma2 * (-0.5 / (sigma2 + 0.33) + 0.17 * albedo / (sigma2 + 0.13));
    float b = 0.45 * sigma2 / (sigma2 + 0.09);
    return max(nl, 0.0) * (a + b * s / max(t, 1e-4)) / kPi;
}

float diffuse_toon(float nl, float roughness) {
    return smoothstep(-roughness, max(roughness, 0.01), nl);
}

/// Reflectance at normal incidence.
vec3 f0_from_material(vec3 albedo, float metallic, float specular) {
    return mix(vec3(0.16 * specular * specular), albedo, metallic);
}

vec3 specular_ggx(float nl, float nv, float lh, float nh, float roughness, vec3 f0) {
    float cl = max(nl, 0.0);
    float alpha = roughness * roughness;
    float d_base = 1.0 + (alpha * alpha - 1.0) * nh * nh;
    float d = alpha * alpha / (kPi * d_base * d_base);
    float k = 0.5 * alpha;
    float g = 0.25 / ((cl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
    return cl * d * g * (f0 + (1.0 - f0) * schlick_weight(lh));
}

float phong_exponent(float roughness) {
    return exp2(15.0 * (1.0 - roughness) + 1.0) * 0.25;
}

float specular_blinn(float nl, float nh, float roughness) {
    float sh = phong_exponent(roughness);
    return pow(nh, sh) * max(nl, 0.0) * (sh + 8.0) / (8.0 * kPi);
}

/// `rv` = R.V with R the mirror direction of L.
float specular_phong(float nl, float nv, float rv, float roughness) {
    float sh = phong_exponent(roughness);
    return pow(max(rv, 0.0), sh) * (sh + 8.0) / (8.0 * kPi) / max(4.0 * nv * max(nl, 0.0), 0.75);
}

float specular_toon(float rv, float roughness) {
    float mid = (1.0 - roughness) * (1.0 - roughness);
    return smoothstep(mid - 0.5 * roughness, mid + 0.5 * roughness, rv) * mid;
}
