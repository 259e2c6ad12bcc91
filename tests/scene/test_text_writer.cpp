#include "tests/scene/text_scene.h"

#include "scene/io/resource_link.h"
#include "scene/io/text_writer.h"

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

std::string rewritten(std::string_view text) {
    register_types();
    Diagnostics diagnostics;
    const Expected<SceneFile> file = parse_scene_text(text, "a.tscn", diagnostics);
    REQUIRE_MESSAGE(file.has_value(), (file ? "" : file.error().to_string()));
    return scene_file_text(*file);
}

constexpr std::string_view kGodotScene = R"([gd_scene load_steps=4 format=2]

[ext_resource path="res://probe_data.tres" type="GIProbeData" id=1]
[ext_resource path="res://a.gd" type="Script" id=3]

[sub_resource type="SpatialMaterial" id=1]
resource_name = "say \"hi\"
and more"
albedo_color = Color( 1, 0.2, 0.2, 1 )

[sub_resource type="CubeMesh" id=2]
material = SubResource( 1 )

[node name="World" type="Spatial"]

[node name="Box" type="MeshInstance" parent="." groups=[
"walls",
]]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0 )
use_in_baked_light = true
mesh = SubResource( 2 )
material/0 = null
script = ExtResource( 3 )
"odd key" = [ 1, 2.5, [  ], PoolIntArray(  ), NodePath("A/B:c") ]
__meta__ = {
"_edit_lock_": true,
"z": {

}
}

[node name="GIProbe" type="GIProbe" parent="Box" index="3"]
data = ExtResource( 1 )
[connection signal="ready" from="Box" to="." method="_on_ready"]
[connection signal="ready" from="." to="Box" method="go" flags=3 binds= [ 1, "x" ]]

[editable path="Box"]
)";

} // namespace

TEST_SUITE("scene/io/text_writer") {
    TEST_CASE("a scene laid out as Godot does is written back to the byte") {
        CHECK(rewritten(kGodotScene) == kGodotScene);
    }

    TEST_CASE("a resource file is written back to the byte") {
        constexpr std::string_view kText =
            "[gd_resource type=\"Environment\" load_steps=2 format=2]\n\n"
            "[sub_resource type=\"ProceduralSky\" id=1]\nsun_latitude = 70.0\n\n"
            "[resource]\nbackground_mode = 2\nbackground_sky = SubResource( 1 )\n";
        CHECK(rewritten(kText) == kText);
    }

    TEST_CASE("tags keep the order and spelling of their fields") {
        CHECK(rewritten("[gd_scene format=2 load_steps=9]\n[node type=\"Node\" name=\"A\" groups=[\"g\"] "
                        "mine=4]\n") ==
              "[gd_scene format=2 load_steps=9]\n\n[node type=\"Node\" name=\"A\" groups=[\"g\"] mine=4]\n");
    }

    TEST_CASE(
        "a file made by code has load steps, quoted indices and the order of fields that Godot writes") {
        SceneFile file;
        file.ext_resources.push_back({1, "Texture", "res://a.png", {}, {}});
        file.sub_resources.push_back({2, "CubeMesh", {}, {}, {}});
        NodeEntry root;
        root.name = "A";
        root.type = "Spatial";
        NodeEntry child;
        child.name = "B \"b\"";
        child.parent = ".";
        child.index = 3;
        child.groups = {"g", "h"};
        child.instance = make_ref<ResourceLink>(ResourceLink::Kind::Ext, 1);
        file.nodes = {root, child};
        file.connections.push_back({"s", ".", "B", "m", 3, {Variant(1)}, {}, {}});
        CHECK(scene_file_text(file) == R"([gd_scene load_steps=3 format=2]

[ext_resource path="res://a.png" type="Texture" id=1]

[sub_resource type="CubeMesh" id=2]

[node name="A" type="Spatial"]

[node name="B \"b\"" parent="." index="3" groups=[
"g",
"h",
] instance=ExtResource( 1 )]
[connection signal="s" from="." to="B" method="m" flags=3 binds= [ 1 ]]
)");
    }

    TEST_CASE("load_steps is left out when there is one step") {
        SceneFile file;
        file.kind = SceneFile::Kind::Resource;
        file.resource_type = "CubeMesh";
        CHECK(scene_file_text(file) == "[gd_resource type=\"CubeMesh\" format=2]\n\n[resource]\n");
    }
}
