#include "tests/scene/text_scene.h"

#include "scene/3d/mesh_instance.h"
#include "scene/3d/spatial.h"

using namespace cl;
using namespace cl::scene;
using cl::tests::TestProject;

namespace {

/// Names of the tree, children in brackets: "A(B C(D))".
std::string shape_of(const Node& node) {
    std::string text = node.name().str();
    if (!node.children().empty()) {
        text += '(';
        for (const std::unique_ptr<Node>& child : node.children()) {
            text += (child->index() > 0 ? " " : "") + shape_of(*child);
        }
        text += ')';
    }
    return text;
}

constexpr std::string_view kChair = R"([gd_scene format=2]
[node name="Chair" type="Spatial"]
[node name="Leg" type="MeshInstance" parent="."]
layers = 4
[node name="Foot" type="Spatial" parent="Leg" groups=["feet"]]
)";

constexpr std::string_view kUsesChair = "[gd_scene format=2]\n"
                                        "[ext_resource path=\"res://chair.tscn\" type=\"PackedScene\" id=4]\n"
                                        "[node name=\"Room\" type=\"Spatial\"]\n";

} // namespace

TEST_SUITE("scene/io/scene_instancer") {
    TEST_CASE("nodes stand in the tree in file order, moved to their index, and belong to the root") {
        TestProject p;
        p.write("a.tscn", R"([gd_scene format=2]
[node name="Root" type="Spatial"]
[node name="A" type="Spatial" parent="."]
[node name="B" type="Spatial" parent="."]
[node name="C" type="Spatial" parent="." index="0"]
[node name="D" type="Spatial" parent="." index="9"]
[node name="E" type="Spatial" parent="./A" index=0]
[node name="F" type="Spatial" parent="A"]
[node name="G" type="Spatial" parent="A" index="1"]
)");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(shape_of(*root) == "Root(C A(E G F) B D)");
        CHECK(root->get_node("A/G")->owner() == root.get());
        CHECK(root->owner() == nullptr);
        CHECK(root->scene_file() == "res://a.tscn");
    }

    TEST_CASE("siblings may have one name: paths find the first") {
        TestProject p;
        p.write("a.tscn", R"([gd_scene format=2]
[node name="Root" type="Spatial"]
[node name="A" type="Spatial" parent="."]
[node name="A" type="Spatial" parent="."]
[node name="B" type="Spatial" parent="A"]
)");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(shape_of(*root) == "Root(A(B) A)");
    }

    TEST_CASE("properties are set in file order: a slot before its mesh is lost with a warning") {
        TestProject p;
        p.write("a.tscn", R"([gd_scene format=2]
[sub_resource type="SpatialMaterial" id=1]
[sub_resource type="CubeMesh" id=2]
[node name="A" type="MeshInstance"]
material/0 = SubResource( 1 )
mesh = SubResource( 2 )
)");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(dynamic_cast<const MeshInstance&>(*root).surface_material(0) == nullptr);
        CHECK(p.warnings().size() == 1);
    }

    TEST_CASE("groups are joined for saving") {
        TestProject p;
        p.write("a.tscn", "[gd_scene]\n[node name=\"A\" type=\"Node\" groups=[\"x\", \"y\"]]\n");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE(root != nullptr);
        CHECK(root->is_in_group("x"));
        REQUIRE(root->groups().size() == 2);
        CHECK(root->groups()[1].saving == GroupSaving::Saved);
    }

    TEST_CASE("a parent that is not there, above or in a circle, is an error") {
        TestProject p;
        CHECK(
            p.outcome(
                "[gd_scene]\n[node name=\"R\" type=\"Node\"]\n[node name=\"A\" type=\"Node\" parent=\"B\"]\n"
                "[node name=\"B\" type=\"Node\" parent=\"A\"]\n") ==
            "a.tscn:3:1: error: expected the path of a node above as \"parent\", found \"B\"");
        CHECK(p.outcome("[gd_scene]\n[node name=\"R\" type=\"Node\"]\n[node name=\"A\" type=\"Node\" "
                        "parent=\"A\"]\n") ==
              "a.tscn:3:1: error: expected the path of a node above as \"parent\", found \"A\"");
        CHECK(p.outcome("[gd_scene]\n[node name=\"R\" type=\"Node\"]\n[node name=\"A\" type=\"Node\" "
                        "parent=\"/root/R\"]\n") ==
              "a.tscn:3:1: error: expected the path of a node above as \"parent\", found \"/root/R\"");
        CHECK(p.outcome("[gd_scene]\n[node name=\"R\" type=\"Node\"]\n[node name=\"A\" type=\"Node\" "
                        "parent=\"..\"]\n") ==
              "a.tscn:3:1: error: expected the path of a node above as \"parent\", found \"..\"");
    }

    TEST_CASE("a class that is no node gives a plain node that keeps its children") {
        TestProject p;
        p.write("a.tscn", "[gd_scene]\n[node name=\"R\" type=\"Spatial\"]\n[node name=\"A\" "
                          "type=\"CubeMesh\" parent=\".\"]\n"
                          "[node name=\"B\" type=\"Spatial\" parent=\"A\"]\n");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(shape_of(*root) == "R(A(B))");
        CHECK(p.warnings() == std::vector<std::string>{
                                  "a.tscn:3:1: warning: nodes of class CubeMesh are kept, without effect"});
    }

    TEST_CASE("an unknown class keeps its place, its transform and what is below it") {
        TestProject p;
        p.write("a.tscn", "[gd_scene]\n[node name=\"R\" type=\"KinematicBody\"]\ncollision_layer = 3\n"
                          "transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0 )\n[node name=\"M\" "
                          "type=\"MeshInstance\" parent=\".\"]\n");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(root->class_name().str() == "KinematicBody");
        CHECK(root->get("collision_layer") == Variant(3));
        const auto& mesh = dynamic_cast<const Spatial&>(*root->get_node("M"));
        CHECK(mesh.global_transform().origin.y == 5.0f);
        CHECK(p.warnings().size() == 1);
    }

    TEST_CASE(
        "instances come with their nodes, take the name and properties given, and can be changed inside") {
        TestProject p;
        p.write("chair.tscn", kChair);
        p.write("a.tscn", std::string(kUsesChair) + R"(
[node name="Chair1" parent="." instance=ExtResource( 4 )]
[node name="Chair2" parent="." instance=ExtResource( 4 )]
visible = false
[node name="Leg" parent="Chair2" index="0" groups=["changed"]]
layers = 2
[node name="Cushion" type="Spatial" parent="Chair2" index="0"]
[node name="Nail" type="Spatial" parent="Chair2/Leg/Foot"]
[editable path="Chair2"]
)");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(shape_of(*root) == "Room(Chair1(Leg(Foot)) Chair2(Cushion Leg(Foot(Nail))))");
        CHECK(root->get_node("Chair1")->get("visible") == Variant(true));
        CHECK(root->get_node("Chair2")->get("visible") == Variant(false));
        CHECK(root->get_node("Chair1/Leg")->get("layers") == Variant(4));
        CHECK(root->get_node("Chair2/Leg")->get("layers") == Variant(2));
        CHECK(root->get_node("Chair2/Leg")->is_in_group("changed"));
        CHECK(root->get_node("Chair2")->owner() == root.get());
        CHECK(root->get_node("Chair2/Leg")->owner() == root->get_node("Chair2"));
        CHECK(root->get_node("Chair2/Cushion")->owner() == root.get());
        CHECK(root->get_node("Chair2")->scene_file() == "res://chair.tscn");
        CHECK(p.warnings().empty());
    }

    TEST_CASE("a resource that is local to its scene is another one in each instance, any other is shared") {
        TestProject p;
        p.write("box.tscn", R"([gd_scene format=2]
[sub_resource type="SpatialMaterial" id=1]
resource_local_to_scene = true
roughness = 0.5
[sub_resource type="SpatialMaterial" id=2]
[node name="Box" type="MeshInstance"]
material_override = SubResource( 1 )
[node name="Lid" type="MeshInstance" parent="."]
material_override = SubResource( 1 )
[node name="Base" type="MeshInstance" parent="."]
material_override = SubResource( 2 )
)");
        p.write("a.tscn", R"([gd_scene format=2]
[ext_resource path="res://box.tscn" type="PackedScene" id=1]
[node name="R" type="Spatial"]
[node name="A" parent="." instance=ExtResource( 1 )]
[node name="B" parent="." instance=ExtResource( 1 )]
)");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        const auto material = [&](const char* path) {
            return root->get_node(path)->get("material_override").to_object();
        };
        CHECK(material("A") == material("A/Lid"));
        CHECK(material("A") != material("B"));
        CHECK(material("B")->get("roughness") == Variant(0.5));
        CHECK(material("A/Base") == material("B/Base"));
    }

    TEST_CASE("an inherited scene starts as its base") {
        TestProject p;
        p.write("chair.tscn", kChair);
        p.write("a.tscn", R"([gd_scene format=2]
[ext_resource path="res://chair.tscn" type="PackedScene" id=1]
[node name="Armchair" instance=ExtResource( 1 )]
[node name="Foot" parent="Leg" index="0"]
visible = false
[node name="Arm" type="Spatial" parent="." index="1"]
)");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(shape_of(*root) == "Armchair(Leg(Foot) Arm)");
        CHECK(root->get_node("Leg/Foot")->get("visible") == Variant(false));
        CHECK(root->scene_file() == "res://a.tscn");
    }

    TEST_CASE("a change to a node that the instance does not have is left out with a warning") {
        TestProject p;
        p.write("chair.tscn", kChair);
        p.write("a.tscn", std::string(kUsesChair) +
                              "[node name=\"C\" parent=\".\" instance=ExtResource( 4 )]\n"
                              "[node name=\"Arm\" parent=\"C\"]\nlayers = 2\n"
                              "[node name=\"X\" type=\"Node\" parent=\"C/Arm\"]\n");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(p.warnings() ==
              std::vector<std::string>{"a.tscn:5:1: warning: expected a node \"./C/Arm\" in the "
                                       "instanced scene, found none: left out"});
    }

    TEST_CASE("an instance of something that is no scene is an error") {
        TestProject p;
        p.write("mat.tres", "[gd_resource type=\"SpatialMaterial\"]\n[resource]\n");
        CHECK(p.outcome("[gd_scene]\n[ext_resource path=\"res://mat.tres\" type=\"PackedScene\" id=1]\n[node "
                        "name=\"R\" type=\"Node\"]\n"
                        "[node name=\"A\" parent=\".\" instance=ExtResource( 1 )]\n") ==
              "a.tscn:4:1: error: expected a scene as \"instance\", found a SpatialMaterial");
    }

    TEST_CASE("scenes that multiply are stopped at a number of nodes") {
        TestProject p;
        p.write("s0.tscn", "[gd_scene]\n[node name=\"N\" type=\"Node\"]\n");
        for (int level = 1; level <= 22; ++level) {
            const std::string below = "res://s" + std::to_string(level - 1) + ".tscn";
            p.write("s" + std::to_string(level) + ".tscn",
                    "[gd_scene]\n[ext_resource path=\"" + below +
                        "\" type=\"PackedScene\" id=1]\n[node name=\"N\" type=\"Node\"]\n"
                        "[node name=\"A\" parent=\".\" instance=ExtResource( 1 )]\n[node name=\"B\" "
                        "parent=\".\" instance=ExtResource( 1 )]\n");
        }
        CHECK(p.load("s22.tscn") == nullptr);
        CHECK(p.error().find("expected a scene of at most 1048576 nodes, found more") != std::string::npos);
    }

    TEST_CASE("nodes nested without end are one located error") {
        TestProject p;
        std::string text = "[gd_scene]\n[node name=\"N\" type=\"Node\"]\n", parent = ".";
        for (int depth = 0; depth < 3000; ++depth) {
            text += "[node name=\"N\" type=\"Node\" parent=\"" + parent + "\"]\n";
            parent = depth == 0 ? "N" : parent + "/N";
        }
        const std::string outcome = p.outcome(text);
        CHECK(outcome.substr(0, 7) == "a.tscn:");
        CHECK(outcome.find("error") != std::string::npos);
    }

    TEST_CASE("connections call the method of their target") {
        TestProject p;
        p.write("a.tscn", "[gd_scene]\n[node name=\"R\" type=\"Spatial\"]\n[node name=\"A\" type=\"Spatial\" "
                          "parent=\".\"]\n"
                          "[connection signal=\"ready\" from=\"A\" to=\".\" method=\"hide\"]\n"
                          "[connection signal=\"ready\" from=\"None\" to=\".\" method=\"hide\"]\n");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(p.warnings().empty());
        if (root->get_node("A")->class_info().has_signal("ready") && root->class_info().find_method("hide")) {
            root->get_node("A")->emit_signal("ready");
            CHECK(root->get("visible") == Variant(false));
        }
    }
}
