// shaders/lib/scene_vertex.glsl -- where a vertex lands on the screen; vertex stage
// needs    lib/vertex_inputs.glsl, lib/frame_block.glsl, lib/draw_block.glsl
// The depth and the scene pass share these very operations: their depths must be equal to the bit.
invariant gl_Position;

vec3 place_vertex() {
    vec3 local = a_position + a_normal * draw_grow_m;
    vec3 view = (draw_view_from_local * vec4(local, 1.0)).xyz;
    gl_Position = frame_clip_from_view * vec4(view, 1.0);
    return view;
}
