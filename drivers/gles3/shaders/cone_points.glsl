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
#include "lib/surface_vertex.glsl"

void main() {
    surface_vertex(a_color); // its alpha counts alone
}

#pragma stage fragment
#include "lib/surface_inputs.glsl"
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
