// depth.glsl -- depth alone, as the camera sees it: the prepass that lets the scene pass shade each pixel once
#pragma flags ALPHA_SCISSOR
#pragma validate
#pragma validate ALPHA_SCISSOR

#include "lib/frame_block.glsl"
#include "lib/draw_block.glsl"

#pragma stage vertex
#include "lib/vertex_inputs.glsl"
#include "lib/scene_vertex.glsl"
out vec4 v_color;
out vec2 v_uv;

void main() {
    place_vertex();
    v_color = a_color;
    v_uv = a_uv;
}

#pragma stage fragment
#ifdef ALPHA_SCISSOR
in vec4 v_color;
in vec2 v_uv;
uniform sampler2D albedo_map;

void main() {
    float alpha = draw_albedo.a * texture(albedo_map, v_uv * draw_uv1.xy + draw_uv1.zw).a;
    if (alpha * mix(1.0, v_color.a, draw_vertex_color) < draw_alpha_scissor) {
        discard;
    }
}
#else
void main() {
}
#endif
