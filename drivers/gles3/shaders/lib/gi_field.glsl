// shaders/lib/gi_field.glsl -- light that patches of surface, or the air, receive from everywhere; library, no main()
// space    view space [m]; look-ups in the field's cells
// needs    lib/draw_block.glsl
// layout   servers/radiosity/field_map.h; light is radiance averaged over the cosine-weighted hemisphere
#ifdef GI_FIELD
uniform highp usampler2D field_bricks;
uniform highp usampler2D field_joints;
uniform sampler2D field_light;
uniform sampler3D field_air;

const int kFieldRow = 1024; // drivers/gles3/gi_field_storage.h
const float kFieldFade = 4.0; // cells over which a field fades to plain ambient light: its grid's margin about the box

ivec2 field_texel(int entry) {
    return ivec2(entry & (kFieldRow - 1), entry >> 10);
}

/// How many bits are set. Source: Warren, "Hacker's Delight", section 5-1 (GLSL ES 3.00 has no bitCount).
uint field_bit_count(uint v) {
    v -= (v >> 1) & 0x55555555u;
    v = (v & 0x33333333u) + ((v >> 2) & 0x33333333u);
    return (((v + (v >> 4)) & 0x0F0F0F0Fu) * 0x01010101u) >> 24;
}

/// Number of a cell with patches of a facing; -1 if it has none.
int field_cell(GIProbe probe, int facing, ivec3 cell) {
    ivec3 b = cell >> 2;
    ivec3 c = cell & 3;
    ivec3 n = probe.field_bricks;
    bool inside = all(greaterThanEqual(b, ivec3(0))) && all(lessThan(b, n));
    int brick = probe.field_first_brick + ((facing * n.z + b.z) * n.y + b.y) * n.x + b.x;
    uvec4 words = texelFetch(field_bricks, field_texel(inside ? brick : 0), 0);
    int bit = c.x | (c.y << 2) | (c.z << 4);
    uint word = bit < 32 ? words.x : words.y;
    uint mask = 1u << uint(bit & 31);
    uint before = (bit < 32 ? 0u : words.w) + field_bit_count(word & (mask - 1u));
    return inside && (word & mask) != 0u ? int(words.z + before) : -1;
}

/// Where a patch is said to lie among those of its cell, 0..1.
vec3 field_place(uvec2 joint) {
    uint bits = (joint.x >> 27) | (((joint.y >> 27) & 15u) << 5);
    return (vec3(uvec3(bits, bits >> 3, bits >> 6) & 7u) + 0.5) / 8.0;
}

/// How ill a patch fits a point of its cell: layers of surface differ along the normal, walls that meet by it.
float field_distance(vec3 within, vec3 normal, uvec2 joint) {
    bool by_normal = ((joint.y >> 13) & 1u) != 0u;
    vec3 apart = (by_normal ? 0.5 + 0.5 * normal : within) - field_place(joint);
    float rise = by_normal ? 0.0 : dot(apart, normal);
    return dot(apart, apart) + 8.0 * rise * rise;
}

/// Light of the surface around a point of it: patches of the 8 nearest cells, of those that go on from the point's
/// own. a: 1, or 0 where the field has no patch.
vec4 surface_light(GIProbe probe, vec3 at, vec3 normal) {
    vec3 size = abs(normal);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    float side = axis == 0 ? normal.x : (axis == 1 ? normal.y : normal.z);
    int facing = axis * 2 + (side < 0.0 ? 1 : 0);
    vec3 behind = at - 0.002 * normal; // a face on the border of two cells belongs to the one behind it
    ivec3 home = ivec3(floor(behind));
    int home_cell = field_cell(probe, facing, home);
    int home_slot = max(home_cell, 0) * 2;
    uvec2 joint = texelFetch(field_joints, field_texel(home_slot), 0).xy;
    uvec2 other = texelFetch(field_joints, field_texel(home_slot + 1), 0).xy;
    vec3 within = behind - vec3(home);
    bool second = (joint.y >> 31) != 0u &&
                  field_distance(within, normal, other) < field_distance(within, normal, joint);
    joint = second ? other : joint;
    // Without a patch of its own a point takes what is around it.
    uint goes_on = home_cell >= 0 ? joint.x : 0xFFFFFFFFu;
    uint slots = home_cell >= 0 ? ((joint.y & ~(1u << 13)) | (second ? 1u << 13 : 0u)) : 0u;
    vec3 corner = floor(behind - 0.5);
    vec3 f = behind - 0.5 - corner;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) {
        ivec3 step = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        ivec3 cell = ivec3(corner) + step;
        ivec3 from_home = cell - home + 1;
        uint bit = 1u << uint(from_home.x + 3 * from_home.y + 9 * from_home.z);
        int number = field_cell(probe, facing, cell);
        int slot = max(number, 0) * 2 + ((slots & bit) != 0u ? 1 : 0);
        vec3 light = texelFetch(field_light, field_texel(slot), 0).rgb;
        vec3 w = mix(1.0 - f, f, vec3(step));
        float weight = number >= 0 && (goes_on & bit) != 0u ? w.x * w.y * w.z : 0.0;
        sum += vec4(light, 1.0) * weight;
    }
    return sum.a > 1e-4 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0);
}

/// One slab of the air's light.
vec3 air_slab(GIProbe probe, vec3 at, int slab) {
    vec3 size = vec3(textureSize(field_air, 0));
    vec3 dims = vec3(probe.field_bricks);
    vec3 texel = clamp(at * 0.25, vec3(0.5), dims - 0.5); // no filtering across the border of a slab
    texel += vec3(probe.field_air_at) + vec3(0.0, 0.0, float(slab) * dims.z);
    return textureLod(field_air, texel / size, 0.0).rgb;
}

/// Light that a surface turned to `normal` (world space) would receive in the air: from the 8 points around, of those
/// that reach it before they meet a wall.
vec3 air_light(GIProbe probe, vec3 at, vec3 normal) {
    vec3 place = at * 0.25 - 0.5;
    vec3 corner = floor(place);
    vec3 f = place - corner;
    ivec3 last = probe.field_bricks - 1;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) {
        ivec3 step = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        ivec3 point = clamp(ivec3(corner) + step, ivec3(0), last);
        ivec3 texel = point + probe.field_air_at;
        vec4 mean = texelFetch(field_air, texel, 0);
        vec4 x = texelFetch(field_air, texel + ivec3(0, 0, probe.field_bricks.z), 0);
        vec4 y = texelFetch(field_air, texel + ivec3(0, 0, 2 * probe.field_bricks.z), 0);
        vec4 z = texelFetch(field_air, texel + ivec3(0, 0, 3 * probe.field_bricks.z), 0);
        vec3 reach = vec3(x.a, y.a, z.a);
        vec3 apart = at - (vec3(point) * 4.0 + 2.0);
        vec3 below = floor(reach / 32.0);
        vec3 allowed = mix(reach - 32.0 * below, below, vec3(lessThan(apart, vec3(0.0)))) * 0.25;
        bool reaches = all(lessThanEqual(abs(apart), allowed + 0.25));
        vec3 w = mix(1.0 - f, f, vec3(step));
        float weight = w.x * w.y * w.z * (reaches ? 1.0 : 1e-4) + 1e-8;
        vec3 light = mean.rgb + 2.0 * (normal.x * x.rgb + normal.y * y.rgb + normal.z * z.rgb);
        sum += vec4(max(light, vec3(0.0)), 1.0) * weight;
    }
    return sum.rgb / sum.a;
}

/// How much more light the bumped normal receives than the mesh's: as far as the air can tell (world space).
float bump_factor(GIProbe probe, vec3 at, vec3 normal, vec3 bumped) {
    const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
    float mean = dot(air_slab(probe, at, 0), kLuminance);
    vec3 slope = 2.0 * vec3(dot(air_slab(probe, at, 1), kLuminance), dot(air_slab(probe, at, 2), kLuminance),
                            dot(air_slab(probe, at, 3), kLuminance));
    float least = 0.25 * mean + 1e-6;
    return max(mean + dot(slope, bumped), least) / max(mean + dot(slope, normal), least);
}

/// 1 inside a probe's box, falling to 0 at the faces of its grid.
float field_share(GIProbe probe, vec3 at) {
    vec3 margin = min(at, probe.bounds - at);
    return clamp(min(margin.x, min(margin.y, margin.z)) / kFieldFade, 0.0, 1.0);
}

struct FieldPoint {
    vec3 position;
    vec3 mesh_normal; // patches lie on the mesh ...
    vec3 normal;      // ... whatever a normal map makes of it
    vec3 reflection;  // mirror direction of the eye's ray
    float roughness;
    vec3 environment; // what reflections meet outside the box
};

struct FieldSum {
    vec3 diffuse;
    vec3 specular;
    float share; // of the point that probes have taken
};

/// The mesh's normal, unless it points away from the side that is seen: files have such triangles, and the patches of
/// the other side are another world.
vec3 seen_side(FieldPoint point) {
    vec3 flat_normal = cross(dFdx(point.position), dFdy(point.position));
    flat_normal *= dot(flat_normal, point.position) > 0.0 ? -1.0 : 1.0;
    return dot(flat_normal, point.mesh_normal) > 0.0 ? point.mesh_normal : normalize(flat_normal + 1e-20);
}

vec3 field_diffuse(GIProbe probe, vec3 at, FieldPoint point) {
    mat3 world_from_view = mat3(frame_world_from_view);
#ifdef GI_AIR
    return air_light(probe, at, world_from_view * point.normal);
#else
    vec4 found = surface_light(probe, at, normalize(mat3(probe.cells_from_view) * seen_side(point)));
    // A pixel that finds no patch (slivers, grown shells) takes what the air around it has.
    vec3 light = found.a > 0.0 ? found.rgb : air_slab(probe, at, 0);
#ifdef NORMAL_MAP
    light *= bump_factor(probe, at, world_from_view * point.mesh_normal, world_from_view * point.normal);
#endif
    return light;
#endif
}

#ifdef GI_GLOSS
/// Light from the mirror direction: one cone through what leaves the surfaces, what it misses from outside. The march
/// is that of lib/cone_trace.glsl on texels that hold square roots (servers/radiosity/radiance_volume.h).
vec3 field_specular(sampler3D volume, GIProbe probe, vec3 at, FieldPoint point, vec3 diffuse) {
    mat3 cells_from_view = mat3(probe.cells_from_view);
    vec3 direction = normalize(cells_from_view * point.reflection);
    vec3 normal = normalize(cells_from_view * point.mesh_normal);
    float rise = max(dot(direction, normal), 0.0);
    float rho = point.roughness * point.roughness;
    float tan_half = tan(rho * 0.5 * 3.14159265359 * 0.99);
    vec3 color = vec3(0.0);
    float alpha = 0.0;
    ConeMarch march = cone_march(tan_half, 1.0);
    while (march.distance < probe.reach && alpha < 0.95) {
        // Held off the surface by its own width: a lobe has no part below the horizon.
        float height = max(1.5 + march.distance * rise, cone_diameter(march));
        vec3 along = march.distance * (direction - rise * normal);
        vec4 s = textureLod(volume, (at + along + height * normal) * probe.uv_from_cells, march.lod);
        color += s.rgb * s.rgb / max(s.a, 1e-3) * (1.0 - alpha);
        alpha += s.a * (1.0 - alpha);
        step_cone(march);
    }
    vec3 met = mix(point.environment, color * probe.field_range / max(alpha, 1e-3), min(alpha / 0.95, 1.0));
    // Cones that have become wider than walls are see through them: what they would meet is what the surface itself
    // receives, then, and always for the rougher half.
    float width = smoothstep(4.0, 16.0, cone_diameter(march));
    return mix(met, diffuse, max(width, smoothstep(0.5, 0.7, point.roughness)));
}
#endif

/// Adds a probe's light where those before it leave room.
void add_gi_field(sampler3D volume, GIProbe probe, FieldPoint point, inout FieldSum sum) {
    vec3 at = (probe.cells_from_view * vec4(point.position, 1.0)).xyz;
    vec3 diffuse = field_diffuse(probe, at, point);
#ifdef GI_GLOSS
    vec3 specular = field_specular(volume, probe, at, point, diffuse);
#else
    vec3 specular = diffuse;
#endif
    float share = field_share(probe, at) * (1.0 - sum.share);
    sum.diffuse += diffuse * probe.multiplier * share;
    sum.specular += specular * probe.multiplier * share;
    sum.share += share;
}
#endif
