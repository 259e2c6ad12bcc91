// shaders/lib/light_set_block.glsl -- the omni and spot lights that reach one instance; block, no main()
// space    view space; colours linear; distances in metres
// filled   by drivers/gles3/light_sets.cpp: instances with the same lights share one copy
const int kMaxLocalLights = 8; // of each kind: spec scene-classes section 8

struct LocalLight {
    vec3 position;
    float range;
    vec3 color; // energy * pi
    float attenuation; // exponent
    vec3 shadow_color; // factor that is left in shadow
    float specular;
    vec3 axis; // spots: against their direction
    float cos_angle; // spots: of the half angle
    float angle_attenuation; // spots: exponent
    int has_shadow;
    float shadow_step; // off the surface before a look-up [m for each m from the light]
    float shadow_near; // OMNI_FACES: of the faces' projection [m]
    vec4 shadow_rect; // its place in the atlas: xy + uv * zw; OMNI_FACES: see omni_face_at
    mat4 shadow_from_view; // spots: to (u, v, depth) * w; omnis: to the light's own axes [m]
};

layout(std140) uniform LightSet {
    int set_omni_count;
    int set_spot_count;
    LocalLight set_omnis[kMaxLocalLights];
    LocalLight set_spots[kMaxLocalLights];
};
