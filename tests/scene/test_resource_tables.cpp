#include "tests/scene/property_laws.h"
#include "tests/scene/scene_fixture.h"

#include "core/variant/variant_parser.h"

#include <doctest/doctest.h>

using namespace cl;
using cl::tests::check_choice;
using cl::tests::Choice;
using cl::tests::own_stored_properties;
using cl::tests::register_types;

namespace {

/// Own properties of a class in save order, as a file would assign their defaults.
struct Table {
    const char* class_name;
    const char* base;
    const char* defaults;
};

/// Spec scene-classes sections 14 to 18 and gi-probe-data section 2.
constexpr Table kTables[] = {
    {"Resource", "Reference", R"(resource_local_to_scene = false resource_name = "")"},
    {"Material", "Resource", "render_priority = 0 next_pass = null"},
    {"ShaderMaterial", "Material", "shader = null"},
    {"SpatialMaterial", "Material", R"(
flags_transparent = false flags_use_shadow_to_opacity = false flags_unshaded = false flags_vertex_lighting = false
flags_no_depth_test = false flags_use_point_size = false flags_world_triplanar = false flags_fixed_size = false
flags_albedo_tex_force_srgb = false flags_do_not_receive_shadows = false flags_disable_ambient_light = false
flags_ensure_correct_normals = false
vertex_color_use_as_albedo = false vertex_color_is_srgb = false
params_diffuse_mode = 0 params_specular_mode = 0 params_blend_mode = 0 params_cull_mode = 0
params_depth_draw_mode = 0 params_line_width = 1.0 params_point_size = 1.0 params_billboard_mode = 0
params_billboard_keep_scale = false params_grow = false params_grow_amount = 0.0
params_use_alpha_scissor = false params_alpha_scissor_threshold = 0.98
particles_anim_h_frames = 1 particles_anim_v_frames = 1 particles_anim_loop = false
albedo_color = Color( 1, 1, 1, 1 ) albedo_texture = null
metallic = 0.0 metallic_specular = 0.5 metallic_texture = null metallic_texture_channel = 0
roughness = 1.0 roughness_texture = null roughness_texture_channel = 0
emission_enabled = false emission = Color( 0, 0, 0, 1 ) emission_energy = 1.0 emission_operator = 0
emission_on_uv2 = false emission_texture = null
normal_enabled = false normal_scale = 1.0 normal_texture = null
rim_enabled = false rim = 1.0 rim_tint = 0.5 rim_texture = null
clearcoat_enabled = false clearcoat = 1.0 clearcoat_gloss = 0.5 clearcoat_texture = null
anisotropy_enabled = false anisotropy = 0.0 anisotropy_flowmap = null
ao_enabled = false ao_light_affect = 0.0 ao_texture = null ao_on_uv2 = false ao_texture_channel = 0
depth_enabled = false depth_scale = 0.05 depth_deep_parallax = false depth_min_layers = 8 depth_max_layers = 32
depth_flip_tangent = false depth_flip_binormal = false depth_texture = null
subsurf_scatter_enabled = false subsurf_scatter_strength = 0.0 subsurf_scatter_texture = null
transmission_enabled = false transmission = Color( 0, 0, 0, 1 ) transmission_texture = null
refraction_enabled = false refraction_scale = 0.05 refraction_texture = null refraction_texture_channel = 0
detail_enabled = false detail_mask = null detail_blend_mode = 0 detail_uv_layer = 0 detail_albedo = null
detail_normal = null
uv1_scale = Vector3( 1, 1, 1 ) uv1_offset = Vector3( 0, 0, 0 ) uv1_triplanar = false uv1_triplanar_sharpness = 1.0
uv2_scale = Vector3( 1, 1, 1 ) uv2_offset = Vector3( 0, 0, 0 ) uv2_triplanar = false uv2_triplanar_sharpness = 1.0
proximity_fade_enable = false proximity_fade_distance = 1.0
distance_fade_mode = 0 distance_fade_min_distance = 0.0 distance_fade_max_distance = 10.0)"},
    {"Mesh", "Resource", "lightmap_size_hint = Vector2( 0, 0 )"},
    {"ArrayMesh", "Mesh", "blend_shape_mode = 1 custom_aabb = AABB( 0, 0, 0, 0, 0, 0 )"},
    {"PrimitiveMesh", "Mesh", "material = null custom_aabb = AABB( 0, 0, 0, 0, 0, 0 ) flip_faces = false"},
    {"CubeMesh", "PrimitiveMesh",
     "size = Vector3( 2, 2, 2 ) subdivide_width = 0 subdivide_height = 0 subdivide_depth = 0"},
    {"SphereMesh", "PrimitiveMesh",
     "radius = 1.0 height = 2.0 radial_segments = 64 rings = 32 is_hemisphere = false"},
    {"PlaneMesh", "PrimitiveMesh", "size = Vector2( 2, 2 ) subdivide_width = 0 subdivide_depth = 0"},
    {"QuadMesh", "PrimitiveMesh", "size = Vector2( 1, 1 )"},
    {"PrismMesh", "PrimitiveMesh",
     "left_to_right = 0.5 size = Vector3( 2, 2, 2 ) subdivide_width = 0 subdivide_height = 0 subdivide_depth "
     "= 0"},
    {"CylinderMesh", "PrimitiveMesh",
     "top_radius = 1.0 bottom_radius = 1.0 height = 2.0 radial_segments = 64 rings = 4"},
    {"CapsuleMesh", "PrimitiveMesh", "radius = 1.0 mid_height = 1.0 radial_segments = 64 rings = 8"},
    {"Image", "Resource", "data = {}"},
    {"ImageTexture", "Texture",
     "flags = 7 storage = 0 lossy_quality = 0.7 image = null size = Vector2( 0, 0 )"},
    {"StreamTexture", "Texture", R"(flags = 0 load_path = "")"},
    {"Sky", "Resource", "radiance_size = 2"},
    {"PanoramaSky", "Sky", "panorama = null"},
    {"ProceduralSky", "Sky", R"(
sky_top_color = Color( 0.647059, 0.839216, 0.945098, 1 ) sky_horizon_color = Color( 0.839216, 0.917647, 0.980392, 1 )
sky_curve = 0.09 sky_energy = 1.0
ground_bottom_color = Color( 0.156863, 0.184314, 0.211765, 1 )
ground_horizon_color = Color( 0.423529, 0.396078, 0.372549, 1 ) ground_curve = 0.02 ground_energy = 1.0
sun_color = Color( 1, 1, 1, 1 ) sun_latitude = 35.0 sun_longitude = 0.0 sun_angle_min = 1.0 sun_angle_max = 100.0
sun_curve = 0.05 sun_energy = 1.0 texture_size = 2)"},
    {"Environment", "Resource", R"(
background_mode = 0 background_sky = null background_sky_custom_fov = 0.0
background_sky_orientation = Basis( 1, 0, 0, 0, 1, 0, 0, 0, 1 ) background_color = Color( 0, 0, 0, 1 )
background_energy = 1.0 background_canvas_max_layer = 0 background_camera_feed_id = 1
ambient_light_color = Color( 0, 0, 0, 1 ) ambient_light_energy = 1.0 ambient_light_sky_contribution = 1.0
fog_enabled = false fog_color = Color( 0.5, 0.6, 0.7, 1 ) fog_sun_color = Color( 1, 0.9, 0.7, 1 )
fog_sun_amount = 0.0 fog_depth_enabled = true fog_depth_begin = 10.0 fog_depth_end = 100.0 fog_depth_curve = 1.0
fog_transmit_enabled = false fog_transmit_curve = 1.0
fog_height_enabled = false fog_height_min = 10.0 fog_height_max = 0.0 fog_height_curve = 1.0
tonemap_mode = 0 tonemap_exposure = 1.0 tonemap_white = 1.0
auto_exposure_enabled = false auto_exposure_scale = 0.4 auto_exposure_min_luma = 0.05
auto_exposure_max_luma = 8.0 auto_exposure_speed = 0.5
ss_reflections_enabled = false ss_reflections_max_steps = 64 ss_reflections_fade_in = 0.15
ss_reflections_fade_out = 2.0 ss_reflections_depth_tolerance = 0.2 ss_reflections_roughness = true
ssao_enabled = false ssao_radius = 1.0 ssao_intensity = 1.0 ssao_radius2 = 0.0 ssao_intensity2 = 1.0
ssao_bias = 0.01 ssao_light_affect = 0.0 ssao_ao_channel_affect = 0.0 ssao_color = Color( 0, 0, 0, 1 )
ssao_quality = 1 ssao_blur = 3 ssao_edge_sharpness = 4.0
dof_blur_far_enabled = false dof_blur_far_distance = 10.0 dof_blur_far_transition = 5.0 dof_blur_far_amount = 0.1
dof_blur_far_quality = 1
dof_blur_near_enabled = false dof_blur_near_distance = 2.0 dof_blur_near_transition = 1.0
dof_blur_near_amount = 0.1 dof_blur_near_quality = 1
glow_enabled = false glow_levels/1 = false glow_levels/2 = false glow_levels/3 = true glow_levels/4 = false
glow_levels/5 = true glow_levels/6 = false glow_levels/7 = false
glow_intensity = 0.8 glow_strength = 1.0 glow_bloom = 0.0 glow_blend_mode = 2 glow_hdr_threshold = 1.0
glow_hdr_luminance_cap = 12.0 glow_hdr_scale = 2.0 glow_bicubic_upscale = false
adjustment_enabled = false adjustment_brightness = 1.0 adjustment_contrast = 1.0 adjustment_saturation = 1.0
adjustment_color_correction = null)"},
    {"GIProbeData", "Resource", R"(
bounds = AABB( 0, 0, 0, 1, 1, 1 ) cell_size = 1.0 to_cell_xform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 )
dynamic_data = PoolIntArray(  ) dynamic_range = 1 energy = 1.0 bias = 0.4 normal_bias = 0.4 propagation = 1.0
interior = false compress = false)"},
};

std::vector<TextAssignment> rows_of(const Table& table) {
    std::vector<TextAssignment> rows;
    VariantReader reader(table.defaults, table.class_name);
    for (;;) {
        Expected<TextItem> item = reader.next_item();
        REQUIRE(item.has_value());
        auto* assignment = std::get_if<TextAssignment>(&*item);
        if (!assignment) {
            return rows;
        }
        rows.push_back(std::move(*assignment));
    }
}

} // namespace

TEST_SUITE("scene/resources") {
    TEST_CASE(
        "every resource class has the properties of its table, in save order, with defaults and a sentence") {
        register_types();
        for (const Table& table : kTables) {
            CAPTURE(table.class_name);
            const ClassInfo* info = ClassRegistry::instance().find(table.class_name);
            REQUIRE(info != nullptr);
            CHECK(info->parent->name.str() == table.base);
            const std::vector<TextAssignment> rows = rows_of(table);
            const std::vector<const PropertyInfo*> own = own_stored_properties(*info);
            REQUIRE(own.size() == rows.size());
            // Defaults of an abstract class are those of an object of a class below it.
            std::unique_ptr<Object> object = ClassRegistry::instance().create(table.class_name);
            for (const ClassInfo* c : ClassRegistry::instance().classes()) {
                object = !object && c->create && c->is_a(info->name) ? c->create() : std::move(object);
            }
            REQUIRE(object != nullptr);
            for (size_t i = 0; i < own.size(); ++i) {
                CAPTURE(rows[i].key);
                CHECK(own[i]->name.str() == rows[i].key);
                CHECK(own[i]->get(*object) == *own[i]->convert(rows[i].value));
                CHECK(!own[i]->doc.empty());
            }
        }
    }

    TEST_CASE(
        "a fresh resource has nothing to save, and each property takes back its own value and nothing odd") {
        register_types();
        for (const Table& table : kTables) {
            CAPTURE(table.class_name);
            const std::unique_ptr<Object> object = ClassRegistry::instance().create(table.class_name);
            if (!object) {
                continue; // abstract
            }
            CHECK(object->stored_properties().empty());
            for (const PropertyInfo* p : own_stored_properties(object->class_info())) {
                CAPTURE(p->name.str());
                if (p->type != Variant::Type::Dictionary) {
                    CHECK(object->set(p->name, object->get(p->name)) == SetResult::Done);
                    CHECK(object->set(p->name, Dictionary()) == SetResult::WrongType);
                }
            }
            CHECK(object->stored_properties().empty());
        }
    }

    TEST_CASE("numbers beyond an enumeration are refused and the old one is kept") {
        register_types();
        const Choice kChoices[] = {
            {"SpatialMaterial", "params_diffuse_mode"},
            {"SpatialMaterial", "params_cull_mode"},
            {"SpatialMaterial", "emission_operator"},
            {"Environment", "background_mode"},
            {"Environment", "tonemap_mode"},
            {"ProceduralSky", "texture_size"},
            {"ProceduralSky", "radiance_size"},
        };
        for (const Choice& choice : kChoices) {
            check_choice(choice, {7, 255, 256}, 1);
        }
    }
}
