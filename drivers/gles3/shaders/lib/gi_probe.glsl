// shaders/lib/gi_probe.glsl -- light that one GI probe's volume gathers at a point; library, no main()
// space    view space [m]; the march itself in the probe's cells
// needs    lib/frame_block.glsl, lib/draw_block.glsl, lib/cone_trace.glsl
// source   spec gi-shading sections 3 to 5
struct GIPoint {
    vec3 position;
    vec3 normal;
    vec3 reflection;  // mirror direction of the eye's ray
    float roughness;  // of the material, not squared
    vec3 ambient;     // what cones that leave the volume meet, diffuse ...
    vec3 environment; // ... and specular
};

struct GISum {
    vec4 diffuse;  // rgb weighted by a
    vec4 specular;
};

/// Columns: two tangents and the normal. It turns with the camera, as the specification has it.
mat3 gi_frame(vec3 normal) {
    vec3 up = abs(normal.z) < 0.999 ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0);
    vec3 tangent = normalize(cross(up, normal));
    vec3 binormal = normalize(cross(tangent, normal));
    return mat3(tangent, binormal, normal);
}

/// All cones of a probe go through one march, so that its code is compiled once: the last is the specular one.
void add_gi_probe(sampler3D volume, GIProbe probe, GIPoint at, inout GISum sum) {
    mat3 cells_from_view = mat3(probe.cells_from_view);
    vec3 surface = (probe.cells_from_view * vec4(at.position, 1.0)).xyz;
    vec3 offset = cells_from_view * at.normal * probe.normal_bias;
    vec3 origin = surface + offset;
    vec3 from_center = abs(2.0 * origin / probe.bounds - 1.0);
    float blend = clamp(1.0 - max(from_center.x, max(from_center.y, from_center.z)), 0.0, 1.0);
    bool inside = all(greaterThanEqual(origin, vec3(0.0))) && all(lessThanEqual(origin, probe.bounds));
    int diffuse_cones = frame_cone_count;
    int cones = inside ? diffuse_cones + 1 : 0; // a loop of no rounds costs nothing; a branch would cost both sides
    mat3 cells_from_frame = cells_from_view * gi_frame(at.normal);
    float rho = at.roughness * at.roughness;
    float specular_tan = max(frame_specular_least_tan, tan(rho * 0.5 * 3.14159265359 * 0.99));
    float max_distance = probe.reach * frame_cone_reach;
    vec3 diffuse = vec3(0.0);
    vec3 specular = vec3(0.0);
    for (int i = 0; i < cones; ++i) {
        bool is_specular = i == diffuse_cones;
        vec4 cone = frame_cones[min(i, kMaxCones - 1)];
        // A diffuse cone ends 1 m from the unbiased point: with a normal bias all of them bend.
        vec3 direction = is_specular ? cells_from_view * at.reflection : cells_from_frame * cone.xyz - offset;
        float tan_half = is_specular ? specular_tan : frame_cone_tan;
        vec4 got = trace_cone(volume, probe.uv_from_cells, origin, normalize(direction), tan_half, probe.bias,
                              max_distance);
        vec3 miss = is_specular ? at.environment : at.ambient;
        vec3 mixed = mix(miss, got.rgb, min(1.0, got.a / 0.95));
        vec3 color = probe.blend_ambient != 0 ? mixed : got.rgb;
        diffuse += is_specular ? vec3(0.0) : cone.w * color;
        specular += is_specular ? color : vec3(0.0);
    }
    float factor = inside ? blend : 0.0;
    sum.diffuse += vec4(diffuse * probe.multiplier, 1.0) * factor;
    sum.specular += vec4(specular * probe.multiplier, 1.0) * factor;
}

/// Replaces ambient and environment by what the probes gathered; by nothing, where none reaches.
void resolve_gi(GISum sum, inout vec3 ambient, inout vec3 environment) {
    bool has_probes = draw_gi_count > 0;
    ambient = has_probes ? sum.diffuse.rgb / max(sum.diffuse.a, 1e-20) : ambient;
    environment = has_probes ? sum.specular.rgb / max(sum.specular.a, 1e-20) : environment;
}
