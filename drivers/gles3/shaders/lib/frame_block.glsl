// shaders/lib/frame_block.glsl -- what is the same for all draws of a frame; block, no main()
// space    view space unless a name says otherwise; colours linear; distances in metres
// filled   by drivers/gles3/frame_block.cpp, once a frame
const int kMaxDirectionalLights = 16; // spec scene-classes section 8
const int kMaxSplits = 4;
const int kMaxCones = 6; // diffuse; the specular cone comes on top

struct DirectionalLight {
    vec3 to_light; // unit length
    float specular;
    vec3 color; // energy * pi
    int splits; // of the shadow map; 0: casts no shadow
    vec3 shadow_color; // factor that is left in shadow
    int blend_splits;
    vec4 shadow_row_x; // rows of shadow space from view: two axes across the light's rays ...
    vec4 shadow_row_y;
    vec4 shadow_row_z; // ... and one along them
    vec4 split_uv[kMaxSplits];    // place in the shadow map = (x, y) * .xy + .zw
    vec4 split_limits[kMaxSplits]; // the middles of its outermost texels: least xy, greatest zw
    vec4 split_depth[kMaxSplits]; // stored depth = z * x + y; the split covers view depths w to z
    float fade_begin; // view depths between which the shadow fades out
    float fade_end;
    float shadow_step; // off the surface before a look-up [texels]
};

layout(std140) uniform Frame {
    mat4 frame_clip_from_view;
    mat4 frame_view_from_world;
    mat4 frame_world_from_view;
    mat4 frame_sky_from_view;    // rotation into the sky maps' space
    vec3 frame_ambient_color;    // energy not applied
    float frame_ambient_energy;
    vec3 frame_environment;      // what smooth surfaces reflect where there is no sky
    float frame_background_energy;
    float frame_sky_contribution; // part of the ambient light that comes from the sky
    int frame_directional_count;
    float frame_shadow_tap;      // from tap to tap of a shadow filter [texels]
    float frame_light_passes;    // times that emission, and ambient light without GI, count
    int frame_cone_count;        // diffuse cones of a GI probe
    vec4 frame_cones[kMaxCones]; // xyz: direction in (tangent, binormal, normal), w: weight
    float frame_cone_tan;        // of half their aperture
    float frame_cone_reach;      // part of a probe's diagonal that cones may go
    float frame_specular_least_tan;
    int frame_fog_depth_on;
    vec4 frame_fog_color;        // a: density
    vec3 frame_fog_sun_color;
    float frame_fog_sun_amount;
    float frame_fog_depth_begin;
    float frame_fog_depth_end;
    float frame_fog_depth_curve;
    int frame_fog_transmit_on;
    float frame_fog_transmit_curve;
    int frame_fog_height_on;
    float frame_fog_height_min;
    float frame_fog_height_max;
    float frame_fog_height_curve;
    DirectionalLight frame_directional[kMaxDirectionalLights];
};
