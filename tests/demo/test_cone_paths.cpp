#include "tests/scene/text_scene.h"

#include "scene/3d/gi_probe.h"
#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"

#include "drivers/gl_context.h"
#include "drivers/gles3/rasterizer_gles3.h"

#include "servers/cones/gather.h"
#include "servers/rasterizer_checked.h"
#include "servers/visual_server.h"

#include "core/image.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

// Cones traced by the shaders and by the CPU give one picture.
namespace {

using namespace cl;

/// A floor, a wall and things of every kind of material that GI knows, in two probes that overlap.
const std::string kScene = R"([gd_scene load_steps=20 format=2]

[sub_resource type="CubeMesh" id=1]
size = Vector3( 8, 0.4, 6 )

[sub_resource type="CubeMesh" id=2]
size = Vector3( 0.4, 3, 6 )

[sub_resource type="SphereMesh" id=3]
radius = 0.6
height = 1.2

[sub_resource type="SpatialMaterial" id=4]
albedo_color = Color( 0.9, 0.3, 0.2, 1 )

[sub_resource type="SpatialMaterial" id=5]
metallic = 0.8
roughness = 0.3

[sub_resource type="SpatialMaterial" id=6]
flags_transparent = true
albedo_color = Color( 0.3, 0.8, 1, 0.5 )

[sub_resource type="SpatialMaterial" id=7]
flags_transparent = true
params_depth_draw_mode = 3
albedo_color = Color( 0.3, 1, 0.4, 0.6 )

[sub_resource type="SpatialMaterial" id=8]
params_use_alpha_scissor = true
params_alpha_scissor_threshold = 0.5
albedo_color = Color( 1, 0.9, 0.3, 0.9 )

[sub_resource type="SpatialMaterial" id=9]
flags_unshaded = true
albedo_color = Color( 0.2, 0.2, 0.7, 1 )

[sub_resource type="Environment" id=10]
background_mode = 1
background_color = Color( 0.2, 0.3, 0.5, 1 )
ambient_light_color = Color( 0.4, 0.3, 0.2, 1 )
ambient_light_energy = 0.5

[node name="Root" type="Spatial"]

[node name="World" type="WorldEnvironment" parent="."]
environment = SubResource( 10 )

[node name="Floor" type="MeshInstance" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -0.2, 0 )
use_in_baked_light = true
mesh = SubResource( 1 )

[node name="Wall" type="MeshInstance" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, -3.8, 1.5, 0 )
use_in_baked_light = true
mesh = SubResource( 2 )
material/0 = SubResource( 4 )

[node name="Glossy" type="MeshInstance" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, -2.2, 0.6, 0 )
mesh = SubResource( 3 )
material/0 = SubResource( 5 )

[node name="Clear" type="MeshInstance" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, -0.6, 0.6, 1 )
mesh = SubResource( 3 )
material/0 = SubResource( 6 )

[node name="Prepass" type="MeshInstance" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.6, 0.6, 0 )
mesh = SubResource( 3 )
material/0 = SubResource( 7 )

[node name="Scissor" type="MeshInstance" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0.6, 0 )
use_in_baked_light = true
mesh = SubResource( 3 )
material/0 = SubResource( 8 )

[node name="Flat" type="MeshInstance" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 3.3, 0.6, 0.4 )
mesh = SubResource( 3 )
material/0 = SubResource( 9 )

[node name="Far" type="MeshInstance" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.6, -8 )
mesh = SubResource( 3 )

[node name="Left" type="GIProbe" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, -1.6, 1.2, 0 )
subdiv = 0
extents = Vector3( 2.6, 2, 3.2 )
normal_bias = 0.1

[node name="Right" type="GIProbe" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 1.9, 1.2, 0 )
subdiv = 0
extents = Vector3( 2.4, 2, 3.2 )
interior = true

[node name="Lamp" type="OmniLight" parent="."]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.4, 2.4, 1 )
omni_range = 9.0

[node name="Camera" type="Camera" parent="."]
transform = Transform( 1, 0, 0, 0, 0.94, 0.34, 0, -0.34, 0.94, 0, 3, 7.5 )
current = true
)";

struct Drawn {
    Image image;
    bool cones_gathered = false;
};

/// Nothing if there is no GL.
std::optional<Drawn> draw(gles3::ConePath path, Quality quality) {
    Expected<std::unique_ptr<drivers::GLContext>> context = drivers::create_offscreen_context();
    if (!context) {
        MESSAGE("skipped: " << context.error().to_string());
        return std::nullopt;
    }
    Expected<std::unique_ptr<gles3::RasterizerGLES3>> made =
        gles3::RasterizerGLES3::create(std::move(*context), path);
    REQUIRE(made.has_value());
    const gles3::RasterizerGLES3& rasterizer = **made;
    auto server = std::make_unique<VisualServer>(std::make_unique<RasterizerChecked>(std::move(*made)));
    server->set_settings({.gi_mode = GIMode::Cones, .quality = quality});
    scene::SceneTree tree(std::move(server), {.size = {243, 137}});
    tests::TestProject project;
    project.write("a.tscn", kScene);
    std::unique_ptr<scene::Node> root = project.load();
    REQUIRE_MESSAGE(root != nullptr, project.error());
    for (const char* name : {"Left", "Right"}) {
        REQUIRE(root->get_node_as<scene::GIProbe>(name)->bake().has_value());
    }
    REQUIRE(tree.set_scene(std::move(root)).ok());
    REQUIRE(tree.draw_settled().ok());
    Expected<Image> image = tree.server()->viewport_read(tree.world().viewport(), TargetFormat::Srgb8);
    REQUIRE(image.has_value());
    return Drawn{*std::move(image), rasterizer.counters().cones_gathered};
}

} // namespace

TEST_SUITE("demo/cone_paths") {
    TEST_CASE("[gl] cones on the CPU draw the picture of the shaders' cones") {
        if (!cones::can_gather()) {
            MESSAGE("skipped: this processor has no AVX2");
            return;
        }
        for (const Quality quality : {Quality::Low, Quality::High}) {
            CAPTURE(int(quality));
            const std::optional<Drawn> shaders = draw(gles3::ConePath::InShader, quality);
            const std::optional<Drawn> cpu = draw(gles3::ConePath::Gathered, quality);
            if (!shaders || !cpu) {
                return;
            }
            CHECK(!shaders->cones_gathered);
            CHECK(cpu->cones_gathered);
            const std::vector<uint8_t>&a = cpu->image.data, &b = shaders->image.data;
            REQUIRE(a.size() == b.size());
            int worst = 0, differ = 0;
            for (size_t i = 0; i < a.size(); ++i) {
                const int apart = std::abs(int(a[i]) - int(b[i]));
                worst = std::max(worst, apart);
                differ += apart > 0 ? 1 : 0;
            }
            // The driver's logarithms and square roots differ in the last digits, so that here and there a
            // weight of 1/256 or the end of a cone does.
            CHECK(worst <= 2);
            CHECK(differ <= int(a.size() / 200));
        }
    }
}
