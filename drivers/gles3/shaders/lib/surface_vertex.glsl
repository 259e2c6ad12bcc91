// shaders/lib/surface_vertex.glsl -- what a surface's fragments need of its vertices; vertex stage
// needs    lib/vertex_inputs.glsl, lib/scene_vertex.glsl, lib/draw_block.glsl
// read     by lib/surface_inputs.glsl
out vec3 v_position; // view space [m]
out vec3 v_normal;   // not of unit length
out vec3 v_tangent;
out vec3 v_binormal;
out vec4 v_color;    // linear
out vec2 v_uv;
out vec2 v_uv2;

void surface_vertex(vec4 color) {
    v_position = place_vertex();
    mat3 normal_from_local = mat3(draw_normal_x.xyz, draw_normal_y.xyz, draw_normal_z.xyz);
    v_normal = normal_from_local * a_normal;
    v_tangent = normal_from_local * a_tangent.xyz;
    v_binormal = normal_from_local * (cross(a_normal, a_tangent.xyz) * a_tangent.w);
    v_color = color;
    v_uv = a_uv;
    v_uv2 = a_uv2;
}
