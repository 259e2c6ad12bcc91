#include "tests/scene/text_scene.h"

#include "scene/io/scene_packer.h"
#include "scene/io/text_writer.h"

using namespace cl;
using namespace cl::scene;
using cl::tests::TestProject;

namespace {

/// a.tscn loaded into nodes and packed again.
std::string packed_text(TestProject& p) {
    const std::unique_ptr<Node> root = p.load();
    REQUIRE_MESSAGE(root != nullptr, p.error());
    const Expected<Ref<PackedScene>> scene = p.loader().load_scene(p.file("a.tscn"));
    const Expected<SceneFile> file = pack_scene(*root, p.loader(), p.diagnostics(),
                                                {.path = "res://a.tscn", .original = (*scene)->file().get()});
    REQUIRE_MESSAGE(file.has_value(), (file ? "" : file.error().to_string()));
    return scene_file_text(*file);
}

constexpr std::string_view kScene = R"([gd_scene load_steps=5 format=2]

[ext_resource path="res://mats/red.tres" type="SpatialMaterial" id=2]

[sub_resource type="SpatialMaterial" id=7]
roughness = 0.25
emission_enabled = true
emission = Color( 1, 0.5, 0, 1 )
emission_energy = 1.0
emission_operator = 0
emission_on_uv2 = false

[sub_resource type="CubeMesh" id=3]
material = SubResource( 7 )
size = Vector3( 1, 2, 3 )

[sub_resource type="BoxShape" id=9]
extents = Vector3( 1, 1, 1 )

[node name="World" type="Spatial"]

[node name="Box" type="MeshInstance" parent="." groups=[
"a",
"b",
]]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0 )
use_in_baked_light = true
mesh = SubResource( 3 )
material/0 = ExtResource( 2 )

[node name="Body" type="StaticBody" parent="Box"]
collision_layer = 3

[node name="Shape" type="CollisionShape" parent="Box/Body"]
shape = SubResource( 9 )
[connection signal="ready" from="Box" to="." method="_on_ready"]

[editable path="Box"]
)";

} // namespace

TEST_SUITE("scene/io/scene_packer") {
    TEST_CASE("a scene that was loaded into nodes is packed back to the byte") {
        TestProject p;
        p.write("mats/red.tres",
                "[gd_resource type=\"SpatialMaterial\" format=2]\n\n[resource]\nmetallic = 1.0\n");
        p.write("a.tscn", kScene);
        CHECK(packed_text(p) == kScene);
    }

    TEST_CASE("of instances only what was changed is packed") {
        TestProject p;
        p.write("chair.tscn", R"([gd_scene format=2]
[node name="Chair" type="Spatial"]
[node name="Leg" type="MeshInstance" parent="."]
layers = 4
[node name="Foot" type="Spatial" parent="Leg" groups=["feet"]]
)");
        constexpr std::string_view kText = R"([gd_scene load_steps=2 format=2]

[ext_resource path="res://chair.tscn" type="PackedScene" id=4]

[node name="Room" type="Spatial"]

[node name="Chair1" parent="." instance=ExtResource( 4 )]

[node name="Chair2" parent="." instance=ExtResource( 4 )]
visible = false

[node name="Leg" parent="Chair2" index="1"]
layers = 1

[node name="Nail" type="Spatial" parent="Chair2/Leg/Foot" index="0"]

[node name="Cushion" type="Spatial" parent="Chair2" index="2"]
)";
        p.write("a.tscn", std::string(kText));
        // The index of Leg is where it stands after Cushion has found its place below it.
        std::string expected(kText);
        expected.replace(expected.find("index=\"1\""), 9, "index=\"0\"");
        expected.replace(expected.find("index=\"2\""), 9, "index=\"1\"");
        CHECK(packed_text(p) == expected);
    }

    TEST_CASE("an inherited scene stays one") {
        TestProject p;
        p.write("chair.tscn", "[gd_scene]\n[node name=\"Chair\" type=\"Spatial\"]\n[node name=\"Leg\" "
                              "type=\"Spatial\" parent=\".\"]\n");
        constexpr std::string_view kText = R"([gd_scene load_steps=2 format=2]

[ext_resource path="res://chair.tscn" type="PackedScene" id=1]

[node name="Armchair" instance=ExtResource( 1 )]
visible = false

[node name="Arm" type="Spatial" parent="." index="1"]
)";
        p.write("a.tscn", kText);
        CHECK(packed_text(p) == kText);
    }

    TEST_CASE("a tree made by code gets ids from 1 and its sub resources before their users") {
        TestProject p;
        p.write("a.tscn", "[gd_scene]\n[node name=\"A\" type=\"Node\"]\n");
        REQUIRE(p.load() != nullptr);
        const ClassRegistry& registry = ClassRegistry::instance();
        std::unique_ptr<Object> object = registry.create("MeshInstance");
        auto* root = dynamic_cast<Node*>(object.get());
        REQUIRE(root != nullptr);
        root->set_name("Box");
        const Ref<Reference> mesh = registry.create_ref("QuadMesh");
        REQUIRE(mesh->set("material", Variant(registry.create_ref("SpatialMaterial"))) == SetResult::Done);
        REQUIRE(root->set("mesh", Variant(mesh)) == SetResult::Done);
        const Expected<SceneFile> file = pack_scene(*root, p.loader(), p.diagnostics());
        REQUIRE(file.has_value());
        CHECK(scene_file_text(*file) == R"([gd_scene load_steps=3 format=2]

[sub_resource type="SpatialMaterial" id=1]

[sub_resource type="QuadMesh" id=2]
material = SubResource( 1 )

[node name="Box" type="MeshInstance"]
mesh = SubResource( 2 )
material/0 = null
)");
    }
}
