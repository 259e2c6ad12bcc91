// shaders/lib/draw_block.glsl -- one instance's place, material and GI probes; block, no main()
// space    as the members say; colours linear. Switches are 0 or 1
// filled   by drivers/gles3/draw_block.cpp, once a draw
struct GIProbe {
    mat4 cells_from_view;
    vec3 bounds;           // size of the box, or of the field's grid [cells]
    float multiplier;      // radiance from texture values
    vec3 uv_from_cells;    // texture coordinates
    float bias;            // where cones start [cells]
    float normal_bias;     // [m]
    float reach;           // the box's diagonal [cells]
    int blend_ambient;     // ambient light enters where cones leave
    ivec3 field_bricks;    // of a GI field: lib/gi_field.glsl
    int field_first_brick;
    ivec3 field_air_at;    // texel where its slabs of air begin
    float field_range;     // radiance of a texel of 1
};

layout(std140) uniform Draw {
    mat4 draw_view_from_local;
    vec4 draw_normal_x; // columns of view_from_local for normals
    vec4 draw_normal_y;
    vec4 draw_normal_z;
    vec4 draw_albedo;   // straight alpha
    vec3 draw_emission; // colour * energy
    float draw_emission_energy; // of the texture
    float draw_metallic;
    float draw_specular;
    float draw_roughness;
    float draw_normal_scale;
    vec4 draw_metallic_channel; // dot with the texel
    vec4 draw_roughness_channel;
    vec4 draw_ao_channel;
    vec4 draw_uv1;      // xy: scale, zw: offset
    float draw_ao_light_affect;
    float draw_alpha_scissor;
    float draw_grow_m;
    float draw_back_side;   // -1: back faces turn their normals
    int draw_emission_multiplies;
    int draw_emission_on_uv2;
    int draw_ao_on_uv2;
    int draw_uses_alpha;    // else the output's alpha is 1
    float draw_vertex_color;
    float draw_vertex_color_srgb;
    float draw_receives_ambient;
    int draw_receives_shadows;
    int draw_directional_mask; // bit i: directional light i counts
    int draw_gi_count; // of the probes below that reach the instance; 0: it keeps its ambient light
    float draw_cone_set; // 1 + number of those probes among the sets whose light is gathered on the CPU; 0: none
    GIProbe draw_gi[2];
};
