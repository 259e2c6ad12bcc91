// cone_points.glsl -- depth, and what the cones of GI probes start from: the prepass of surfaces whose light is gathered
// space    view space [m]
// output   0: place, and in w 1 + the number of the probes that reach it, or 0; 1: shading normal, and roughness
// read     by drivers/gles3/passes/cone_pass.cpp
#pragma flags ALPHA_SCISSOR NORMAL_MAP MORE_MAPS
#pragma validate
#pragma validate ALPHA_SCISSOR
#pragma validate ALPHA_SCISSOR NORMAL_MAP MORE_MAPS

#include "lib/frame_block.glsl"
#include "lib/draw_block.glsl"

#pragma stage vertex
#include "lib/vertex_inputs.glsl"
#include "lib/scene_vertex.glsl"
out vec3 v_position;
out vec3 v_normal;
out vec3 v_tangent;
out vec3 v_binormal;
out vec4 v_color;
out vec2 v_uv;
out vec2 v_uv2;

void main() {
    v_position = place_vertex();
    mat3 normal_from_local = mat3(draw_normal_x.xyz, draw_normal_y.xyz, draw_normal_z.xyz);
    v_normal = normal_from_local * a_normal;
    v_tangent = normal_from_local * a_tangent.xyz;
    v_binormal = normal_from_local * (cross(a_normal, a_tangent.xyz) * a_tangent.w);
    v_color = a_color; // its alpha counts alone
    v_uv = a_uv;
    v_uv2 = a_uv2;
}

#pragma stage fragment
in vec3 v_position;
in vec3 v_normal;
in vec3 v_tangent;
in vec3 v_binormal;
in vec4 v_color;
in vec2 v_uv;
in vec2 v_uv2;
layout(location = 0) out vec4 out_place;
layout(location = 1) out vec4 out_shape;

#define ALBEDO_MAP // bound in all variants: few are holes'
#include "lib/color_space.glsl"
#include "lib/material.glsl"

void main() {
#ifdef ALPHA_SCISSOR
    if (material_albedo().a < draw_alpha_scissor) {
        discard;
    }
#endif
    out_place = vec4(v_position, draw_cone_set);
    out_shape = vec4(material_normal(), material_gloss().y);
}
