// omni_paraboloid.glsl -- an omni light's six depth faces, as the two paraboloids that the scene pass looks up
// space    directions in the light's own axes; `faces` holds perspective depths
// output   depth = (distance from the light + bias) / range
// source   spec scene-classes section 9
#pragma flags
#pragma validate

#pragma stage vertex
#include "lib/fullscreen.glsl"
out vec2 v_uv;
void main() {
    v_uv = fullscreen_position();
}

#pragma stage fragment
#include "lib/paraboloid.glsl"
in vec2 v_uv;
uniform samplerCube faces;
uniform vec2 near_far; // of the faces' projection [m]
uniform float bias;    // [m]
uniform float range;   // [m]

void main() {
    vec3 direction = paraboloid_direction(v_uv);
    float depth = 2.0 * textureLod(faces, direction, 0.0).r - 1.0;
    float near = near_far.x;
    float far = near_far.y;
    float along_axis = 2.0 * near * far / (far + near - depth * (far - near));
    vec3 a = abs(direction);
    float distance = along_axis / max(a.x, max(a.y, a.z));
    gl_FragDepth = (distance + bias) / range;
}
