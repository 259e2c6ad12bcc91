// sky.glsl -- the sky's panorama where nothing was drawn; covers the viewport at the far plane
// space    rays in view space at z = -1; panorama as lib/sky.glsl says
// output   linear radiance
#pragma flags
#pragma validate

#pragma stage vertex
#include "lib/fullscreen.glsl"
uniform vec4 ray; // xy: half size of the view at distance 1, zw: its centre
out vec2 v_ray;
void main() {
    v_ray = (fullscreen_position() * 2.0 - 1.0) * ray.xy + ray.zw;
    gl_Position.z = gl_Position.w;
}

#pragma stage fragment
#include "lib/sky.glsl"
in vec2 v_ray;
layout(location = 0) out vec4 out_color;
uniform sampler2D panorama;
uniform mat3 sky_from_view;
uniform float energy;
uniform float lod; // of the panorama whose texels are as wide as pixels

void main() {
    vec3 direction = normalize(sky_from_view * vec3(v_ray, -1.0));
    out_color = vec4(textureLod(panorama, panorama_uv(direction), lod).rgb * energy, 1.0);
}
