#include "tests/scene/text_scene.h"

#include "scene/io/resource_link.h"

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

std::string error_of(std::string_view text) {
    register_types();
    Diagnostics diagnostics;
    const Expected<SceneFile> file = parse_scene_text(text, "a.tscn", diagnostics);
    return file ? "read" : file.error().to_string();
}

SceneFile file_of(std::string_view text) {
    register_types();
    Diagnostics diagnostics;
    Expected<SceneFile> file = parse_scene_text(text, "a.tscn", diagnostics);
    REQUIRE_MESSAGE(file.has_value(), (file ? "" : file.error().to_string()));
    CHECK(diagnostics.warnings().empty());
    return std::move(*file);
}

constexpr std::string_view kScene = R"([gd_scene load_steps=3 format=2]

[ext_resource path="res://ball.tscn" type="PackedScene" id=7]

[sub_resource type="SpatialMaterial" id=1]
albedo_color = Color( 1, 0.5, 0, 1 )

[sub_resource type="CubeMesh" id=4]
material = SubResource( 1 )

[node name="Root" type="Spatial"]

[node name="Box" type="MeshInstance" parent="." index="2" groups=[
"walls",
"b",
]]
mesh = SubResource( 4 )
material/0 = null

[node name="Ball" parent="Box" instance=ExtResource( 7 )]

[node name="Skin" parent="Box/Ball"]
visible = false
[connection signal="ready" from="." to="Box" method="go" flags=3 binds= [ 1, "x" ]]

[editable path="Box/Ball"]
)";

} // namespace

TEST_SUITE("scene/io/text_reader") {
    TEST_CASE("a scene becomes its headings, resources, nodes, connections and editables") {
        const SceneFile file = file_of(kScene);
        CHECK(file.kind == SceneFile::Kind::Scene);
        REQUIRE(file.ext_resources.size() == 1);
        CHECK(file.ext_resources[0].path == "res://ball.tscn");
        CHECK(file.ext_resources[0].id == 7);
        REQUIRE(file.sub_resources.size() == 2);
        CHECK(file.sub_resources[1].type == "CubeMesh");
        const ResourceLink* link = ResourceLink::in(file.sub_resources[1].properties[0].value);
        REQUIRE(link != nullptr);
        CHECK(link->to_text() == "SubResource( 1 )");

        REQUIRE(file.nodes.size() == 4);
        CHECK(file.nodes[0].path() == ".");
        CHECK(!file.nodes[0].parent.has_value());
        CHECK(file.nodes[1].path() == "./Box");
        CHECK(file.nodes[1].index == 2);
        CHECK(file.nodes[1].groups == std::vector<std::string>{"walls", "b"});
        CHECK(file.nodes[1].properties.size() == 2);
        CHECK(file.nodes[2].path() == "./Box/Ball");
        CHECK(ResourceLink::in(file.nodes[2].instance)->id() == 7);
        CHECK(file.nodes[3].path() == "./Box/Ball/Skin");
        CHECK(file.nodes[3].type.empty());

        REQUIRE(file.connections.size() == 1);
        CHECK(file.connections[0].flags == 3);
        CHECK(file.connections[0].binds.size() == 2);
        REQUIRE(file.editables.size() == 1);
        CHECK(file.editables[0].path == "Box/Ball");
    }

    TEST_CASE("places are those of tags and values") {
        const SceneFile file = file_of(kScene);
        CHECK(file.nodes[1].where.line == 13);
        CHECK(file.nodes[1].where.column == 1);
        CHECK(file.sub_resources[0].properties[0].where.line == 6);
        CHECK(file.sub_resources[0].properties[0].value_where.column == 16);
    }

    TEST_CASE("new lines mean nothing, unknown fields are left out, the last of a repeated field counts") {
        const SceneFile file = file_of("[gd_scene][node name=\"A\" type=\"Node\" colour=3 "
                                       "type=\"Spatial\"]visible=false transform=1\n[node name=\"B\"\n"
                                       "parent=\".\" type=\"Node\"]; the end\n");
        REQUIRE(file.nodes.size() == 2);
        CHECK(file.nodes[0].type == "Spatial");
        CHECK(file.nodes[0].properties.size() == 2);
        CHECK(file.nodes[1].name == "B");
    }

    TEST_CASE("a resource file has one main resource") {
        const SceneFile file =
            file_of("[gd_resource type=\"SpatialMaterial\" format=2]\n\n[resource]\nroughness = 0.5\n");
        CHECK(file.kind == SceneFile::Kind::Resource);
        CHECK(file.resource_type == "SpatialMaterial");
        REQUIRE(file.resource.size() == 1);
        CHECK(file.resource[0].value == Variant(0.5));
    }

    TEST_CASE("a file that is no scene says what was expected and what is there") {
        CHECK(error_of("") ==
              "a.tscn:1:1: error: expected [gd_scene] or [gd_resource], found the end of the file");
        CHECK(error_of("; nothing\n") ==
              "a.tscn:2:1: error: expected [gd_scene] or [gd_resource], found the end of the file");
        CHECK(error_of("[node name=\"A\" type=\"Node\"]") ==
              "a.tscn:1:1: error: expected [gd_scene] or [gd_resource], found [node]");
        CHECK(error_of("a = 1") == "a.tscn:1:1: error: expected [gd_scene] or [gd_resource], found \"a\"");
        CHECK(error_of("[gd_scene format=2]\n") ==
              "a.tscn:2:1: error: expected [node], found the end of the file");
        CHECK(error_of("[gd_resource type=\"CubeMesh\"]\n") ==
              "a.tscn:2:1: error: expected [resource], found the end of the file");
    }

    TEST_CASE("a newer format is refused, an older one or none is read") {
        CHECK(error_of("[gd_scene load_steps=2 format=3]\n[node name=\"A\" type=\"Node\"]") ==
              "a.tscn:1:31: error: expected format 2 or lower, found the newer format 3");
        CHECK(error_of("[gd_scene format=1]\n[node name=\"A\" type=\"Node\"]") == "read");
        CHECK(error_of("[gd_scene load_steps=99]\n[node name=\"A\" type=\"Node\"]") == "read");
    }

    TEST_CASE("tags out of place are errors") {
        CHECK(error_of("[gd_scene]\n[nod name=\"A\"]") ==
              "a.tscn:2:1: error: expected [ext_resource], [sub_resource] or [node], found [nod]");
        CHECK(error_of("[gd_scene]\n[resource]") ==
              "a.tscn:2:1: error: expected [ext_resource], [sub_resource] or [node], found [resource]");
        CHECK(error_of("[gd_resource type=\"CubeMesh\"]\n[node name=\"A\" type=\"Node\"]") ==
              "a.tscn:2:1: error: expected [ext_resource], [sub_resource] or [resource], found [node]");
        CHECK(
            error_of("[gd_scene]\n[node name=\"A\" type=\"Node\"]\n[sub_resource type=\"CubeMesh\" id=1]") ==
            "a.tscn:3:1: error: expected [node], [connection] or [editable], found [sub_resource]");
        CHECK(error_of("[gd_resource type=\"CubeMesh\"]\n[resource]\n[resource]") ==
              "a.tscn:3:1: error: expected the end of the file after [resource], found [resource]");
        CHECK(error_of("[gd_scene]\n[sub_resource type=\"CubeMesh\" id=1]\nsize = Vector3( 1, 1, 1 )") ==
              "a.tscn:3:26: error: expected [node], found the end of the file");
    }

    TEST_CASE("assignments stand only where a tag takes them") {
        CHECK(error_of("[gd_scene]\na = 1\n") == "a.tscn:2:1: error: expected a tag, found \"a\"");
        CHECK(error_of("[gd_scene]\n[ext_resource path=\"a\" type=\"b\" id=1]\na = 1\n") ==
              "a.tscn:3:1: error: expected a tag, found \"a\"");
        CHECK(error_of("[gd_scene]\n[node name=\"A\" type=\"Node\"]\n[editable path=\"A\"]\na = 1\n") ==
              "a.tscn:4:1: error: expected a tag, found \"a\"");
    }

    TEST_CASE("required fields are missed, and wrong ones told by type") {
        CHECK(error_of("[gd_resource format=2]") ==
              "a.tscn:1:1: error: expected a field \"type\" in [gd_resource], found none");
        CHECK(error_of("[gd_scene]\n[ext_resource path=\"a\" id=1]") ==
              "a.tscn:2:1: error: expected a field \"type\" in [ext_resource], found none");
        CHECK(error_of("[gd_scene]\n[sub_resource type=\"CubeMesh\"]") ==
              "a.tscn:2:1: error: expected a field \"id\" in [sub_resource], found none");
        CHECK(error_of("[gd_scene]\n[sub_resource type=\"CubeMesh\" id=\"one\"]") ==
              "a.tscn:2:34: error: expected an int as \"id\" of [sub_resource], found String");
        CHECK(error_of("[gd_scene]\n[node name=5 type=\"Node\"]") ==
              "a.tscn:2:12: error: expected a String as \"name\" of [node], found int");
        CHECK(error_of("[gd_scene]\n[node name=\"A\" type=\"Node\" groups=7]") ==
              "a.tscn:2:35: error: expected an Array of Strings as \"groups\" of [node], found int");
        CHECK(error_of("[gd_scene]\n[node name=\"A\" type=\"Node\"]\n[connection signal=\"s\" from=\".\" "
                       "to=\".\"]") ==
              "a.tscn:3:1: error: expected a field \"method\" in [connection], found none");
    }

    TEST_CASE("nodes need a root above them") {
        CHECK(error_of("[gd_scene]\n[node name=\"A\" type=\"Node\" parent=\".\"]") ==
              "a.tscn:2:1: error: expected no \"parent\" in the first [node], found \".\"");
        CHECK(error_of("[gd_scene]\n[node name=\"A\"]") ==
              "a.tscn:2:1: error: expected a \"type\" or an \"instance\" in the first [node], found neither");
        CHECK(error_of("[gd_scene]\n[node name=\"A\" type=\"Node\"]\n[node name=\"B\" type=\"Node\"]") ==
              "a.tscn:3:1: error: expected a field \"parent\" in every [node] but the first, found none");
        CHECK(error_of("[gd_scene]\n[node name=\"A\" instance=null]") ==
              "a.tscn:2:25: error: expected ExtResource( id ) as \"instance\" of [node], found Nil");
    }

    TEST_CASE("a reference needs its resource above, and a resource cannot refer to itself") {
        CHECK(error_of("[gd_scene]\n[node name=\"A\" type=\"MeshInstance\"]\nmesh = SubResource( 3 )") ==
              "a.tscn:3:8: error: expected the id of a [sub_resource] above, found 3");
        CHECK(error_of("[gd_scene]\n[node name=\"A\" type=\"MeshInstance\"]\nmesh = ExtResource( 3 )") ==
              "a.tscn:3:8: error: expected the id of a [ext_resource] above, found 3");
        CHECK(error_of(
                  "[gd_scene]\n[sub_resource type=\"SpatialMaterial\" id=1]\nnext_pass = SubResource( 1 )") ==
              "a.tscn:3:13: error: expected the id of a [sub_resource] above, found 1");
    }

    TEST_CASE("a scene cut short anywhere is read or gives one located error") {
        register_types();
        for (size_t length = 0; length < kScene.size(); ++length) {
            Diagnostics diagnostics;
            const Expected<SceneFile> file =
                parse_scene_text(kScene.substr(0, length), "a.tscn", diagnostics);
            if (!file) {
                CAPTURE(length);
                CHECK(file.error().where.line > 0);
                CHECK(file.error().message.find('\n') == std::string::npos);
            }
        }
    }

    TEST_CASE("files that cannot be text scenes give one line") {
        const cl::tests::TemporaryDir dir;
        Diagnostics diagnostics;
        const auto message = [&](const std::filesystem::path& file) {
            const Expected<SceneFile> read = read_scene_file(file, diagnostics);
            return read ? std::string("read") : read.error().message;
        };
        CHECK(message(dir / "none.tscn") == "expected a file, found none");
        CHECK(message(dir.path()) == "expected a file, found a directory");
        std::ofstream(dir / "a.scn", std::ios::binary) << "RSCC\x02\x00";
        CHECK(message(dir / "a.scn") == "expected a text scene or resource, found a binary one (RSCC)");
        std::string rubbish("\x7f"
                            "ELF\0\1\2\xff\xfe[[[=",
                            13);
        std::ofstream(dir / "a.tscn", std::ios::binary) << rubbish;
        CHECK(!read_scene_file(dir / "a.tscn", diagnostics));
    }
}
