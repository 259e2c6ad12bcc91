// shaders/lib/cone_trace.glsl -- marches one cone through a radiance volume; library, no main()
// space    voxels of mip 0; direction has unit length in that space
// volume   rgb: radiance over the probe's range, already weighted by what it covers; a: opacity [0, 1]
// source   spec gi-shading section 4.1 (after Crassin et al. 2011). Departs: none
// twin     servers/gi/cone_trace.h, kept equal by tests/drivers/gles3/test_cone_trace.cpp
float cone_diameter(float distance, float tan_half_aperture) {
    return max(1.0, 2.0 * tan_half_aperture * distance); // below one voxel the volume holds no more detail
}

/// Returns gathered rgb, and in a the opacity met (at most a little above 0.95, where the march ends).
/// Samples beyond the texture repeat its edge texels: the march ends by distance, not at the box.
vec4 trace_cone(sampler3D volume, vec3 texel_from_voxel, vec3 origin, vec3 direction, float tan_half_aperture,
                float first_distance, float max_distance) {
    vec3 color = vec3(0.0);
    float alpha = 0.0;
    float distance = first_distance;
    while (distance < max_distance && alpha < 0.95) {
        float diameter = cone_diameter(distance, tan_half_aperture);
        vec4 s = textureLod(volume, (origin + distance * direction) * texel_from_voxel, log2(diameter));
        color += s.rgb * (1.0 - alpha);
        alpha += s.a * (1.0 - alpha);
        distance += diameter * 0.5;
    }
    return vec4(color, alpha);
}
