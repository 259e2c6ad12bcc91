// shaders/lib/fog.glsl -- light lost and gained between a surface and the eye; library, no main()
// space    view space [m]; colours linear radiance
// needs    lib/frame_block.glsl
// source   spec scene-classes section 14.5
/// Returns the fog's colour, and in a how much of the surface it hides. `total` is what the surface sends.
vec4 fog_at(vec3 position, vec3 total) {
    vec3 color = frame_fog_color.rgb;
    if (frame_directional_count > 0) {
        float toward_sun = max(0.0, dot(normalize(position), frame_directional[0].to_light));
        color = mix(color, frame_fog_sun_color, frame_fog_sun_amount * pow(toward_sun, 8.0));
    }
    float amount = 0.0;
    if (frame_fog_depth_on != 0) {
        float z = smoothstep(frame_fog_depth_begin, frame_fog_depth_end, length(position));
        amount = pow(z, frame_fog_depth_curve) * frame_fog_color.a;
        if (frame_fog_transmit_on != 0) {
            color = mix(max(total, color), color, pow(z, frame_fog_transmit_curve));
        }
    }
    if (frame_fog_height_on != 0) {
        float y = (frame_world_from_view * vec4(position, 1.0)).y;
        float z = smoothstep(frame_fog_height_min, frame_fog_height_max, y);
        amount = max(amount, pow(z, frame_fog_height_curve));
    }
    return vec4(color, amount);
}
