// shadow_caster.glsl -- depth of a caster as a light sees it, pushed away from the light by the biases
// space    light view: the light at the origin (or far behind it), looking along -z [m]
// source   spec scene-classes section 9
#pragma flags ALPHA_SCISSOR
#pragma validate
#pragma validate ALPHA_SCISSOR

#pragma stage vertex
#include "lib/vertex_inputs.glsl"
uniform mat4 light_from_local;
uniform mat4 clip_from_light;
uniform vec2 bias; // [m]: everywhere, and where the surface is parallel to the light
uniform float grow; // [m]
out vec2 v_uv;

void main() {
    vec3 position = (light_from_local * vec4(a_position + a_normal * grow, 1.0)).xyz;
    vec3 normal = normalize(mat3(light_from_local) * a_normal + vec3(1e-20));
    position.z -= bias.x + bias.y * (1.0 - abs(normal.z));
    gl_Position = clip_from_light * vec4(position, 1.0);
    v_uv = a_uv;
}

#pragma stage fragment
#ifdef ALPHA_SCISSOR
in vec2 v_uv;
uniform sampler2D albedo_map;
uniform vec4 uv_scale_offset;
uniform vec2 alpha; // x: factor on the texture's, y: what is below is a hole

void main() {
    if (alpha.x * texture(albedo_map, v_uv * uv_scale_offset.xy + uv_scale_offset.zw).a < alpha.y) {
        discard;
    }
}
#else
void main() {
}
#endif
