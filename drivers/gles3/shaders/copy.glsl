// copy.glsl -- shows one level of a texture over the whole viewport, unchanged or as grey
#pragma flags GRAY
#pragma validate
#pragma validate GRAY

#pragma stage vertex
#include "lib/fullscreen.glsl"
out vec2 v_uv;
void main() {
    v_uv = fullscreen_position();
}

#pragma stage fragment
in vec2 v_uv;
layout(location = 0) out vec4 out_color;
uniform sampler2D source;
uniform float lod;
void main() {
    out_color = textureLod(source, v_uv, lod);
#ifdef GRAY
    out_color.rgb = vec3(dot(out_color.rgb, vec3(1.0 / 3.0)));
#endif
}
