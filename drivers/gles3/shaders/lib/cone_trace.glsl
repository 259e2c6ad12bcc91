// shaders/lib/cone_trace.glsl -- marches one cone through a radiance volume; library, no main()
// space    voxels of mip 0; direction has unit length in that space
// volume   rgb: radiance over the probe's range, already weighted by what it covers; a: opacity [0, 1]
// source   spec gi-shading section 4.1 (after Crassin et al. 2011). Departs: none
// twin     servers/gi/cone_trace.h, kept equal by tests/drivers/gles3/test_cone_trace.cpp

/// Where a march is. Steps are half the cone's diameter, which is max(1, 2 tan(a/2) distance): below one voxel the
/// volume holds no more detail. Above it, it grows by 1 + tan(a/2) a step, and its level by a constant: what is below
/// level 0 before is clamped by the sampler. So the logarithms are taken once a cone instead of once a step.
struct ConeMarch {
    float distance;
    float tan_half_aperture;
    float lod;
    float lod_step;
};

ConeMarch cone_march(float tan_half_aperture, float first_distance) {
    float slope = max(tan_half_aperture, 1e-4);
    float narrow_steps = max(0.0, ceil(1.0 / slope - 2.0 * first_distance));
    float lod_step = log2(1.0 + slope);
    float widest = slope * (2.0 * first_distance + narrow_steps); // after them
    return ConeMarch(first_distance, tan_half_aperture, log2(widest) - narrow_steps * lod_step, lod_step);
}

float cone_diameter(ConeMarch march) {
    return max(1.0, 2.0 * march.tan_half_aperture * march.distance);
}

void step_cone(inout ConeMarch march) {
    march.distance += 0.5 * cone_diameter(march);
    march.lod += march.lod_step;
}

/// Returns gathered rgb, and in a the opacity met (at most a little above 0.95, where the march ends).
/// Samples beyond the texture repeat its edge texels: the march ends by distance, not at the box.
vec4 trace_cone(sampler3D volume, vec3 texel_from_voxel, vec3 origin, vec3 direction, float tan_half_aperture,
                float first_distance, float max_distance) {
    vec3 color = vec3(0.0);
    float alpha = 0.0;
    vec3 at = origin * texel_from_voxel;
    vec3 along = direction * texel_from_voxel;
    ConeMarch march = cone_march(tan_half_aperture, first_distance);
    while (march.distance < max_distance && alpha < 0.95) {
        vec4 s = textureLod(volume, at + march.distance * along, march.lod);
        color += s.rgb * (1.0 - alpha);
        alpha += s.a * (1.0 - alpha);
        step_cone(march);
    }
    return vec4(color, alpha);
}
