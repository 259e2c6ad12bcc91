// shaders/lib/lights.glsl -- direct light of all lights of an instance at one point; library, no main()
// space    view space [m]; colours linear
// needs    lib/frame_block.glsl, lib/draw_block.glsl, lib/light_set_block.glsl, lib/brdf.glsl, lib/shadow.glsl,
//          lib/paraboloid.glsl, lib/omni_faces.glsl; samplers shadow_atlas, directional_shadow
// variants DIFFUSE_*, SPECULAR_* choose the reflection; none = Burley, GGX. OMNI_FACES: omnis' maps are six faces, as
//          ShadowFit::ByTexel draws them; none = two paraboloids
// source   spec scene-classes sections 8 and 9. Departs: every directional light in one pass; what Godot's further
//          passes add besides is frame_light_passes
struct Surface {
    vec3 position;
    vec3 mesh_normal;
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

/// False where a light from there adds nothing, so that its shadow need not be looked up.
bool may_light(Surface s, vec3 to_light) {
#if defined(DIFFUSE_WRAP) || defined(DIFFUSE_TOON) || defined(SPECULAR_PHONG) || defined(SPECULAR_TOON)
    return true; // these light surfaces that are turned away, too
#else
    return dot(s.normal, to_light) > 0.0;
#endif
}

/// (1 - d / range)^exponent within the range.
float distance_attenuation(float distance, float range, float exponent) {
    float d = distance / max(0.001, range);
    return d < 1.0 ? pow(1.0 - d, exponent) : 0.0;
}

// --- directional -------------------------------------------------------------------------------------------------

/// A part of the view with its own part of the map: see DirectionalLight.
struct Split {
    vec4 uv;
    vec4 limits;
    vec4 depth;
};

Split split_at(DirectionalLight light, int i) {
    return Split(light.split_uv[i], light.split_limits[i], light.split_depth[i]);
}

float directional_split_shadow(Split split, vec3 p, vec3 step, bool wanted) {
    vec2 texel = 1.0 / vec2(textureSize(directional_shadow, 0));
    vec2 texel_m = texel / split.uv.xy;
    p += step * max(texel_m.x, texel_m.y);
    vec3 at = vec3(p.xy * split.uv.xy + split.uv.zw, p.z * split.depth.x + split.depth.y);
    return shadow_lookup(directional_shadow, at, split.limits, texel * frame_shadow_tap, wanted);
}

float directional_shadow_at(DirectionalLight light, Surface s, bool wanted) {
    float depth = -s.position.z;
    mat4x3 shadow_from_view = transpose(mat3x4(light.shadow_row_x, light.shadow_row_y, light.shadow_row_z));
    vec3 p = shadow_from_view * vec4(s.position, 1.0);
    vec3 step = shadow_from_view * vec4(s.mesh_normal * light.shadow_step, 0.0);
    Split split = split_at(light, kMaxSplits - 1);
    Split next = split;
    for (int i = kMaxSplits - 2; i >= 0; --i) { // not by index: lanes differ, and gathering blocks is slow
        if (depth < light.split_depth[i].z) {
            next = split;
            split = split_at(light, i);
        }
    }
    wanted = wanted && light.splits > 0 && depth < split.depth.z;
    float lit = directional_split_shadow(split, p, step, wanted);
    bool blends = wanted && light.blend_splits != 0;
    float next_lit = directional_split_shadow(next, p, step, blends);
    lit = blends ? mix(lit, next_lit, smoothstep(split.depth.w, split.depth.z, depth)) : lit;
    return mix(lit, 1.0, smoothstep(light.fade_begin, light.fade_end, depth));
}

void add_directional_lights(Surface s, bool shadows_on, inout LightSum sum) {
    for (int i = 0; i < frame_directional_count; ++i) {
        DirectionalLight light = frame_directional[i];
        bool counts = (draw_directional_mask >> i & 1) == 1;
        float lit = directional_shadow_at(light, s, counts && shadows_on && may_light(s, light.to_light));
        vec3 color = light.color * mix(light.shadow_color, vec3(1.0), lit);
        add_light(s, light.to_light, counts ? color : vec3(0.0), light.specular, sum);
    }
}

// --- omni and spot -----------------------------------------------------------------------------------------------

#ifdef OMNI_FACES
float omni_shadow_at(LocalLight light, Surface s, bool wanted) {
    vec3 p = (light.shadow_from_view * vec4(s.position, 1.0)).xyz;
    // Texels of a face are as wide at its rim as in its middle, where the distance is counted along its axis.
    p += mat3(light.shadow_from_view) * s.mesh_normal * (light.shadow_step * omni_face_depth(p));
    vec3 at = omni_face_at(p, light.shadow_rect, light.shadow_near);
    vec2 texel = 1.0 / vec2(textureSize(shadow_atlas, 0));
    const vec4 kNoLimits = vec4(0.0, 0.0, 1.0, 1.0); // the faces' margins hold all taps
    return shadow_lookup(shadow_atlas, at, kNoLimits, texel * frame_shadow_tap, wanted);
}
#else
float omni_shadow_at(LocalLight light, Surface s, bool wanted) {
    vec3 p = (light.shadow_from_view * vec4(s.position, 1.0)).xyz;
    float distance = length(p);
    vec2 texel = 1.0 / vec2(textureSize(shadow_atlas, 0));
    float upper = p.z >= 0.0 ? 0.0 : 0.5;
    vec4 limits = vec4(light.shadow_rect.xy + vec2(0.0, upper) * light.shadow_rect.zw + 0.5 * texel,
                       light.shadow_rect.xy + vec2(1.0, upper + 0.5) * light.shadow_rect.zw - 0.5 * texel);
    vec2 uv = paraboloid_uv(p / distance) * light.shadow_rect.zw + light.shadow_rect.xy;
    vec3 at = vec3(uv, distance / light.range);
    return shadow_lookup(shadow_atlas, at, limits, texel * frame_shadow_tap, wanted);
}
#endif

void add_omni_lights(Surface s, bool shadows_on, inout LightSum sum) {
    for (int i = 0; i < set_omni_count; ++i) {
        LocalLight light = set_omnis[i];
        vec3 to_light = light.position - s.position;
        float distance = length(to_light);
        vec3 direction = to_light / max(distance, 1e-6);
        float attenuation = distance_attenuation(distance, light.range, light.attenuation);
        bool wanted = attenuation > 0.0 && light.has_shadow != 0 && shadows_on && may_light(s, direction);
        float lit = omni_shadow_at(light, s, wanted);
        vec3 color = light.color * attenuation * mix(light.shadow_color, vec3(1.0), lit);
        add_light(s, direction, color, light.specular, sum);
    }
}

float spot_shadow_at(LocalLight light, vec3 position, bool wanted) {
    vec4 p = light.shadow_from_view * vec4(position, 1.0);
    vec2 texel = 1.0 / vec2(textureSize(shadow_atlas, 0));
    vec4 limits = vec4(light.shadow_rect.xy + 0.5 * texel, light.shadow_rect.xy + light.shadow_rect.zw - 0.5 * texel);
    vec3 at = p.xyz / p.w;
    vec2 uv = at.xy * light.shadow_rect.zw + light.shadow_rect.xy;
    return shadow_lookup(shadow_atlas, vec3(uv, at.z), limits, texel * frame_shadow_tap, wanted);
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
        bool wanted = attenuation > 0.0 && light.has_shadow != 0 && shadows_on && may_light(s, to_light);
        float step = light.shadow_step * distance;
        float lit = spot_shadow_at(light, s.position + s.mesh_normal * step, wanted);
        vec3 color = light.color * attenuation * mix(light.shadow_color, vec3(1.0), lit);
        add_light(s, to_light, color, light.specular, sum);
    }
}
