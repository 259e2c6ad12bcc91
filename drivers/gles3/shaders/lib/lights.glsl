// shaders/lib/lights.glsl -- direct light of all lights of an instance at one point; library, no main()
// space    view space [m]; colours linear
// needs    lib/frame_block.glsl, lib/draw_block.glsl, lib/light_set_block.glsl, lib/brdf.glsl, lib/shadow.glsl,
//          lib/paraboloid.glsl; samplers shadow_atlas, directional_shadow
// variants DIFFUSE_*, SPECULAR_* choose the reflection; none = Burley, GGX
// source   spec scene-classes sections 8 and 9. Departs: every directional light in one pass; what Godot's further
//          passes add besides is frame_light_passes
struct Surface {
    vec3 position;
    vec3 normal;
    vec3 to_eye;
    vec3 albedo;
    vec3 f0;
    float metallic;
    float specular;
    float roughness;
};

struct LightSum {
    vec3 diffuse;
    vec3 specular;
};

void add_light(Surface s, vec3 to_light, vec3 color, float specular_factor, inout LightSum sum) {
    vec3 half_way = normalize(s.to_eye + to_light);
    float nl = dot(s.normal, to_light);
    float nv_signed = dot(s.normal, s.to_eye);
    float nv = max(nv_signed, 0.0);
    float lh = max(dot(to_light, half_way), 0.0);
    float nh = max(dot(s.normal, half_way), 0.0);
    float rv = dot(reflect(-to_light, s.normal), s.to_eye);

#if defined(DIFFUSE_LAMBERT)
    vec3 diffuse = vec3(diffuse_lambert(nl));
#elif defined(DIFFUSE_WRAP)
    vec3 diffuse = vec3(diffuse_lambert_wrap(nl, s.roughness));
#elif defined(DIFFUSE_OREN_NAYAR)
    vec3 diffuse = diffuse_oren_nayar(nl, nv_signed, dot(to_light, s.to_eye), s.roughness, s.albedo);
#elif defined(DIFFUSE_TOON)
    vec3 diffuse = vec3(diffuse_toon(nl, s.roughness));
#else
    vec3 diffuse = vec3(diffuse_burley(nl, nv, lh, s.roughness));
#endif
    sum.diffuse += color * s.albedo * diffuse;

#if defined(SPECULAR_DISABLED)
    vec3 specular = vec3(0.0);
#elif defined(SPECULAR_BLINN)
    vec3 specular = vec3(specular_blinn(nl, nh, s.roughness));
#elif defined(SPECULAR_PHONG)
    vec3 specular = vec3(specular_phong(nl, nv, rv, s.roughness));
#elif defined(SPECULAR_TOON)
    // A toon highlight is part of the diffuse light, so that metals lose it with the rest.
    vec3 specular = vec3(0.0);
    sum.diffuse += s.roughness > 0.0 ? color * specular_factor * 2.0 * s.specular * specular_toon(rv, s.roughness)
                                     : vec3(0.0);
#else
    vec3 specular = specular_ggx(nl, nv, lh, nh, s.roughness, s.f0);
#endif
    sum.specular += s.roughness > 0.0 ? color * specular_factor * specular : vec3(0.0);
}

/// (1 - d / range)^exponent within the range.
float distance_attenuation(float distance, float range, float exponent) {
    float d = distance / max(0.001, range);
    return d < 1.0 ? pow(1.0 - d, exponent) : 0.0;
}

// --- directional -------------------------------------------------------------------------------------------------

float directional_split_shadow(vec3 p, vec4 uv, vec4 depth, vec2 texel, bool wanted) {
    // A split's square is wider than its part of the view by more than the filter: no limits are needed.
    vec3 at = vec3(p.xy * uv.xy + uv.zw, p.z * depth.x + depth.y);
    return shadow_lookup(directional_shadow, at, vec4(0.0, 0.0, 1.0, 1.0), texel, wanted);
}

float directional_shadow_at(DirectionalLight light, vec3 position, bool wanted) {
    float depth = -position.z;
    vec4 p4 = vec4(position, 1.0);
    vec3 p = vec3(dot(light.shadow_row_x, p4), dot(light.shadow_row_y, p4), dot(light.shadow_row_z, p4));
    vec4 uv = light.split_uv[kMaxSplits - 1];
    vec4 range = light.split_depth[kMaxSplits - 1];
    vec4 next_uv = uv;
    vec4 next_range = range;
    for (int i = kMaxSplits - 2; i >= 0; --i) {
        if (depth < light.split_depth[i].z) {
            next_uv = uv;
            next_range = range;
            uv = light.split_uv[i];
            range = light.split_depth[i];
        }
    }
    wanted = wanted && light.splits > 0 && depth < range.z;
    vec2 texel = 1.0 / vec2(textureSize(directional_shadow, 0));
    float lit = directional_split_shadow(p, uv, range, texel, wanted);
    bool blends = wanted && light.blend_splits != 0;
    float next_lit = directional_split_shadow(p, next_uv, next_range, texel, blends);
    lit = blends ? mix(lit, next_lit, smoothstep(range.w, range.z, depth)) : lit;
    return mix(lit, 1.0, smoothstep(light.fade_begin, light.fade_end, depth));
}

void add_directional_lights(Surface s, bool shadows_on, inout LightSum sum) {
    for (int i = 0; i < frame_directional_count; ++i) {
        DirectionalLight light = frame_directional[i];
        bool counts = (draw_directional_mask >> i & 1) == 1;
        float lit = directional_shadow_at(light, s.position, counts && shadows_on);
        vec3 color = light.color * mix(light.shadow_color, vec3(1.0), lit);
        add_light(s, light.to_light, counts ? color : vec3(0.0), light.specular, sum);
    }
}

// --- omni and spot -----------------------------------------------------------------------------------------------

float omni_shadow_at(LocalLight light, vec3 position, bool wanted) {
    vec3 p = (light.shadow_from_view * vec4(position, 1.0)).xyz;
    float distance = length(p);
    vec2 texel = 1.0 / vec2(textureSize(shadow_atlas, 0));
    float upper = p.z >= 0.0 ? 0.0 : 0.5;
    vec4 limits = vec4(light.shadow_rect.xy + vec2(0.0, upper) * light.shadow_rect.zw + 0.5 * texel,
                       light.shadow_rect.xy + vec2(1.0, upper + 0.5) * light.shadow_rect.zw - 0.5 * texel);
    vec2 uv = paraboloid_uv(p / distance) * light.shadow_rect.zw + light.shadow_rect.xy;
    return shadow_lookup(shadow_atlas, vec3(uv, distance / light.range), limits, texel, wanted);
}

void add_omni_lights(Surface s, bool shadows_on, inout LightSum sum) {
    for (int i = 0; i < set_omni_count; ++i) {
        LocalLight light = set_omnis[i];
        vec3 to_light = light.position - s.position;
        float distance = length(to_light);
        float attenuation = distance_attenuation(distance, light.range, light.attenuation);
        bool in_reach = attenuation > 0.0 && light.has_shadow != 0 && shadows_on;
        float lit = omni_shadow_at(light, s.position, in_reach);
        vec3 color = light.color * attenuation * mix(light.shadow_color, vec3(1.0), lit);
        add_light(s, to_light / max(distance, 1e-6), color, light.specular, sum);
    }
}

float spot_shadow_at(LocalLight light, vec3 position, bool wanted) {
    vec4 p = light.shadow_from_view * vec4(position, 1.0);
    vec2 texel = 1.0 / vec2(textureSize(shadow_atlas, 0));
    vec4 limits = vec4(light.shadow_rect.xy + 0.5 * texel, light.shadow_rect.xy + light.shadow_rect.zw - 0.5 * texel);
    vec3 at = p.xyz / p.w;
    return shadow_lookup(shadow_atlas, vec3(at.xy * light.shadow_rect.zw + light.shadow_rect.xy, at.z), limits, texel,
                         wanted);
}

void add_spot_lights(Surface s, bool shadows_on, inout LightSum sum) {
    for (int i = 0; i < set_spot_count; ++i) {
        LocalLight light = set_spots[i];
        vec3 from_surface = light.position - s.position;
        float distance = length(from_surface);
        vec3 to_light = from_surface / max(distance, 1e-6);
        float cosine = max(dot(light.axis, to_light), light.cos_angle);
        float rim = max(0.0001, (1.0 - cosine) / max(1.0 - light.cos_angle, 1e-6));
        float attenuation = distance_attenuation(distance, light.range, light.attenuation) *
                            (1.0 - pow(rim, light.angle_attenuation));
        bool in_reach = attenuation > 0.0 && light.has_shadow != 0 && shadows_on;
        float lit = spot_shadow_at(light, s.position, in_reach);
        vec3 color = light.color * attenuation * mix(light.shadow_color, vec3(1.0), lit);
        add_light(s, to_light, color, light.specular, sum);
    }
}
