// shaders/lib/fullscreen.glsl -- one triangle over the viewport from gl_VertexID, without attributes; vertex stage
// Returns the position in 0..1 over the viewport, (0, 0) at its lower left, and sets gl_Position.
vec2 fullscreen_position() {
    vec2 uv = vec2(float((gl_VertexID & 1) << 1), float(gl_VertexID & 2));
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
    return uv;
}
