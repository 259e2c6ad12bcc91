// shaders/lib/paraboloid.glsl -- all directions on two square maps, for omni lights' shadows; library, no main()
// space    directions in the light's own axes, unit length; places in the slot 0..1
/// An omni light's slot holds two paraboloids, one above the other: +z below, -z above. A direction's place in it.
vec2 paraboloid_uv(vec3 direction) {
    vec2 uv = direction.xy / (1.0 + abs(direction.z)) * 0.5 + 0.5;
    return vec2(uv.x, 0.5 * uv.y + (direction.z >= 0.0 ? 0.0 : 0.5));
}

/// The direction that a place in the slot stands for; inverse of paraboloid_uv.
vec3 paraboloid_direction(vec2 uv) {
    bool upper = uv.y >= 0.5;
    vec2 p = vec2(uv.x, 2.0 * uv.y - (upper ? 1.0 : 0.0)) * 2.0 - 1.0;
    float z = 0.5 - 0.5 * dot(p, p);
    return normalize(vec3(p, upper ? -z : z));
}
