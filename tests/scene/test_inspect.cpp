#include "tests/scene/text_scene.h"

#include "scene/io/inspect.h"

using namespace cl;
using namespace cl::scene;
using cl::tests::TestProject;

TEST_SUITE("scene/io/inspect") {
    TEST_CASE("a scene is shown as its file says it, without opening other files") {
        TestProject p;
        p.write("level.tscn", R"([gd_scene load_steps=3 format=2]
[ext_resource path="res://ball.tscn" type="PackedScene" id=1]
[sub_resource type="CubeMesh" id=1]
size = Vector3( 1, 1, 1 )
[node name="Level" type="Spatial" groups=["g"]]
visible = false
[node name="Ball" parent="." instance=ExtResource( 1 )]
transform = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0 )
[node name="Skin" parent="Ball" index="0"]
[connection signal="ready" from="." to="Ball" method="go"]
)");
        const Expected<Inspection> i = inspect_file(p.file("level.tscn"));
        REQUIRE_MESSAGE(i.has_value(), (i ? "" : i.error().to_string()));
        CHECK(i->kind == Inspection::Kind::Scene);
        CHECK(i->warnings.empty());
        REQUIRE(i->nodes.size() == 3);
        CHECK(i->nodes[0].path == ".");
        CHECK(i->nodes[0].type == "Spatial");
        CHECK(i->nodes[0].groups == std::vector<std::string>{"g"});
        CHECK(i->nodes[0].properties == ShownProperties{{"visible", "false"}});
        CHECK(i->nodes[1].path == "./Ball");
        CHECK(!i->nodes[1].type.has_value());
        CHECK(i->nodes[1].instance == "res://ball.tscn");
        CHECK(i->nodes[1].properties[0].second == "Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0 )");
        CHECK(i->nodes[2].path == "./Ball/Skin");
        CHECK(i->nodes[2].index == 0);
        REQUIRE(i->connections.size() == 1);
        CHECK(i->connections[0].from == ".");
        CHECK(i->connections[0].to == "./Ball");
        CHECK(i->connections[0].flags == 2);
        CHECK(i->connections[0].binds == "[  ]");
        REQUIRE(i->resources.size() == 2);
        CHECK(i->resources[0].kind == InspectedResource::Kind::Ext);
        CHECK(i->resources[0].path == "res://ball.tscn");
        CHECK(i->resources[1].type == "CubeMesh");
        CHECK(i->resources[1].properties == ShownProperties{{"size", "Vector3( 1, 1, 1 )"}});
    }

    TEST_CASE("long lists are cut to their size, of a key given twice the last value is shown") {
        TestProject p;
        std::string bytes = "1";
        for (int n = 0; n < 3000; ++n) {
            bytes += ", 1";
        }
        p.write("a.tres", "[gd_resource type=\"Curve\"]\n[resource]\na = PoolByteArray( " + bytes +
                              " )\nb = 1\nb = 2\n");
        const Expected<Inspection> i = inspect_file(p.file("a.tres"));
        REQUIRE(i.has_value());
        CHECK(i->kind == Inspection::Kind::Resource);
        CHECK(i->type == "Curve");
        CHECK(i->properties == ShownProperties{{"a", "<PoolByteArray, 3001 elements>"}, {"b", "2"}});
    }

    TEST_CASE("unknown classes and properties are warnings with their line") {
        TestProject p;
        p.write("a.tscn",
                "[gd_scene]\n[sub_resource type=\"Animation\" id=1]\nlength = 2.0\n[node name=\"A\" "
                "type=\"MeshInstance\"]\n"
                "meshh = 1\nmaterial/0 = null\n[node name=\"B\" type=\"GridMap\" parent=\".\"]\ncell = 2\n");
        const Expected<Inspection> i = inspect_file(p.file("a.tscn"));
        REQUIRE(i.has_value());
        REQUIRE(i->warnings.size() == 3);
        CHECK(i->warnings[0].where.line == 2);
        CHECK(i->warnings[0].message == "resources of class Animation are kept, without effect");
        CHECK(i->warnings[1].where.line == 5);
        CHECK(i->warnings[1].message == "MeshInstance has no property \"meshh\": kept, without effect");
        CHECK(i->warnings[2].where.line == 7);
    }

    TEST_CASE("a parent that is not above and cannot come with an instance is an error at the node") {
        TestProject p;
        const std::string head =
            "[gd_scene]\n[ext_resource path=\"res://b.tscn\" type=\"PackedScene\" id=1]\n"
            "[node name=\"R\" type=\"Spatial\"]\n";
        const auto outcome = [&](const std::string& nodes) {
            p.write("a.tscn", head + nodes);
            const Expected<Inspection> i = inspect_file(p.file("a.tscn"));
            return i ? std::string("shown") : i.error().to_string().substr(p.file("a.tscn").string().size());
        };
        const std::string circle = "[node name=\"A\" type=\"Spatial\" parent=\"B\"]\n"
                                   "[node name=\"B\" type=\"Spatial\" parent=\"A\"]\n";
        CHECK(outcome(circle) == ":4:1: error: expected the path of a node above as \"parent\", found \"B\"");
        CHECK(outcome("[node name=\"A\" type=\"Spatial\" parent=\"A\"]\n") ==
              ":4:1: error: expected the path of a node above as \"parent\", found \"A\"");
        CHECK(outcome("[node name=\"A\" type=\"Spatial\" parent=\".\"]\n"
                      "[node name=\"B\" type=\"Spatial\" parent=\"A/X\"]\n") ==
              ":5:1: error: expected the path of a node above as \"parent\", found \"A/X\"");
        CHECK(outcome("[node name=\"A\" type=\"Spatial\" parent=\"/\"]\n") ==
              ":4:1: error: expected the path of a node above as \"parent\", found \"/\"");
        CHECK(outcome("[node name=\"I\" parent=\".\" instance=ExtResource( 1 )]\n"
                      "[node name=\"B\" type=\"Spatial\" parent=\"I/Hall/Stairs\"]\n"
                      "[node name=\"C\" type=\"Spatial\" parent=\"./I//Hall/Stairs/B\"]\n"
                      "[node name=\"D\" type=\"Spatial\" parent=\"I/../.\"]\n") == "shown");
    }

    TEST_CASE("probe data shows its grid") {
        TestProject p;
        p.write("a.tres",
                "[gd_resource type=\"GIProbeData\"]\n[resource]\nbounds = AABB( -1, -1, -1, 2, 2, 2 )\n"
                "dynamic_data = PoolIntArray( 0, 7, 64, 32, 64, 1, 0, 5, 5, 5, 5, 5, 5, 5, 5, 5, "
                "-1, -1, -1, -1, -1, -1, -1, -1, 0, 0, 8355711, 0 )\n");
        const Expected<Inspection> i = inspect_file(p.file("a.tres"));
        REQUIRE_MESSAGE(i.has_value(), (i ? "" : i.error().to_string()));
        REQUIRE(i->probe.has_value());
        CHECK(i->probe->size == glm::ivec3(64, 32, 64));
        CHECK(i->probe->cells == 1);
        CHECK(i->probe->leaves == 0);
        CHECK(i->probe->levels == 7);
        CHECK(i->probe->bounds.size == glm::vec3(2));
        CHECK(i->probe->bytes == 28 * 4);
    }
}
