#include "tests/scene/text_scene.h"

#include "scene/3d/mesh_instance.h"
#include "scene/resources/environment.h"
#include "scene/resources/missing_resource.h"
#include "scene/resources/primitive_meshes.h"
#include "scene/resources/spatial_material.h"

#include <fmt/format.h>

using namespace cl;
using namespace cl::scene;
using cl::tests::TestProject;

namespace {

/// A scene whose root is a MeshInstance, with these resources above it and these properties.
std::string scene_of(std::string_view resources, std::string_view properties = "") {
    return fmt::format("[gd_scene format=2]\n{}\n[node name=\"A\" type=\"MeshInstance\"]\n{}\n", resources,
                       properties);
}

std::string sub(std::string_view type, std::string_view properties) {
    return fmt::format("[sub_resource type=\"{}\" id=1]\n{}\n", type, properties);
}

} // namespace

TEST_SUITE("scene/io/resource_loader") {
    TEST_CASE("sub resources are made with their properties and shared by those that refer to them") {
        TestProject p;
        p.write("a.tscn", R"([gd_scene format=2]
[sub_resource type="SpatialMaterial" id=3]
roughness = 0.25
[sub_resource type="CubeMesh" id=1]
material = SubResource( 3 )
size = Vector3( 1, 2, 3 )
[node name="A" type="MeshInstance"]
mesh = SubResource( 1 )
material/0 = SubResource( 3 )
)");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        const auto& node = dynamic_cast<const MeshInstance&>(*root);
        const Ref<CubeMesh> mesh = node.mesh().cast<CubeMesh>();
        REQUIRE(mesh);
        CHECK(mesh->shape().size == glm::vec3(1, 2, 3));
        CHECK(mesh->path() == "res://a.tscn::1");
        CHECK(mesh->material() == node.surface_material(0));
        CHECK(mesh->material().cast<SpatialMaterial>()->params().roughness == 0.25f);
        CHECK(p.warnings().empty());
    }

    TEST_CASE("of two sub resources with one id the first counts, of a key given twice the last") {
        TestProject p;
        p.write("a.tscn", scene_of("[sub_resource type=\"CubeMesh\" id=1]\nsize = Vector3( 1, 1, 1 )\nsize = "
                                   "Vector3( 3, 3, 3 )\n"
                                   "[sub_resource type=\"SphereMesh\" id=1]\n",
                                   "mesh = SubResource( 1 )"));
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        const Ref<CubeMesh> mesh = dynamic_cast<const MeshInstance&>(*root).mesh().cast<CubeMesh>();
        REQUIRE(mesh);
        CHECK(mesh->shape().size == glm::vec3(3));
    }

    TEST_CASE("a resource file is loaded once and shared") {
        TestProject p;
        p.write("mats/red.tres",
                "[gd_resource type=\"SpatialMaterial\" format=2]\n[resource]\nmetallic = 1\n");
        p.write("a.tscn", scene_of("[ext_resource path=\"res://mats/red.tres\" type=\"Material\" id=1]\n"
                                   "[ext_resource path=\"mats/red.tres\" type=\"Material\" id=2]\n"
                                   "[sub_resource type=\"CubeMesh\" id=1]\nmaterial = ExtResource( 1 )\n",
                                   "mesh = SubResource( 1 )\nmaterial/0 = ExtResource( 2 "
                                   ")\nmaterial_override = Resource( \"res://mats/red.tres\" )"));
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        const auto& node = dynamic_cast<const MeshInstance&>(*root);
        CHECK(node.surface_material(0) == node.mesh()->surface_material(0));
        CHECK(node.material_override() == node.surface_material(0));
        CHECK(node.surface_material(0)->path() == "res://mats/red.tres");
        CHECK(p.warnings().empty());
    }

    TEST_CASE("a file that is missing is an error at the line that asks for it") {
        TestProject p;
        CHECK(p.outcome(scene_of("[ext_resource path=\"res://none.png\" type=\"Texture\" id=1]")) ==
              "a.tscn:2:1: error: res://none.png: expected a file, found none");
        CHECK(p.outcome(scene_of("[ext_resource path=\"res://none.tscn\" type=\"PackedScene\" id=1]")) ==
              "a.tscn:2:1: error: res://none.tscn: expected a file, found none");
        CHECK(p.outcome(scene_of("[ext_resource path=\"res://../a.tres\" type=\"Material\" id=1]")) ==
              "a.tscn:2:1: error: res://../a.tres: expected a path inside the project, found "
              "\"res://../a.tres\"");
        CHECK(p.outcome(scene_of("[ext_resource path=\"user://a.tres\" type=\"Material\" id=1]")) ==
              "a.tscn:2:1: error: user://a.tres: expected a path that starts with res://, found "
              "\"user://a.tres\"");
        p.write("dir.tres/x", "");
        CHECK(p.outcome(scene_of("[ext_resource path=\"res://dir.tres\" type=\"Material\" id=1]")) ==
              "a.tscn:2:1: error: res://dir.tres: expected a file, found a directory");
        CHECK(p.outcome(scene_of("", "material_override = Resource( \"res://none.tres\" )")) ==
              "a.tscn:4:21: error: expected a file, found none");
    }

    TEST_CASE("an error within a file that is needed has the place in that file") {
        TestProject p;
        p.write("bad.tres", "[gd_resource type=\"SpatialMaterial\" format=2]\n[resource]\nroughness = (\n");
        CHECK(p.outcome(scene_of("[ext_resource path=\"res://bad.tres\" type=\"Material\" id=1]"))
                  .substr(0, 17) == "bad.tres:3:13: er");
        p.write("bin.res", "RSRC....");
        CHECK(
            p.outcome(scene_of("[ext_resource path=\"res://bin.res\" type=\"Mesh\" id=1]")) ==
            "a.tscn:2:1: error: res://bin.res: expected a text scene or resource, found a binary one (RSRC)");
        p.write("bad.png", "\x89PNG\r\n\x1a\n....");
        CHECK(p.outcome(scene_of("[ext_resource path=\"res://bad.png\" type=\"Texture\" id=1]")) ==
              "a.tscn:2:1: error: res://bad.png: damaged PNG: the data ends early");
    }

    TEST_CASE("files that need each other in a circle are an error") {
        TestProject p;
        p.write("b.tscn", "[gd_scene]\n[ext_resource path=\"res://a.tscn\" type=\"PackedScene\" id=1]\n[node "
                          "name=\"B\" type=\"Node\"]\n");
        CHECK(p.outcome("[gd_scene]\n[ext_resource path=\"res://b.tscn\" type=\"PackedScene\" id=1]\n[node "
                        "name=\"A\" type=\"Node\"]\n") ==
              "b.tscn:2:1: error: res://a.tscn: expected a file that does not need itself, found a circle of "
              "files");
        CHECK(p.outcome("[gd_scene]\n[ext_resource path=\"res://a.tscn\" type=\"PackedScene\" id=1]\n[node "
                        "name=\"A\" instance=ExtResource( 1 )]\n") ==
              "a.tscn:2:1: error: res://a.tscn: expected a file that does not need itself, found a circle of "
              "files");
    }

    TEST_CASE("scripts and classes that we do not have are warned about once, kept, and need no file") {
        TestProject p;
        p.write("a.tscn", R"([gd_scene format=2]
[ext_resource path="res://a.gd" type="Script" id=1]
[ext_resource path="res://b.gd" type="Script" id=2]
[sub_resource type="BoxShape" id=1]
extents = Vector3( 1, 1, 1 )
[sub_resource type="BoxShape" id=2]
[node name="A" type="Spatial"]
script = ExtResource( 1 )
speed = 3.5
[node name="B" type="CollisionShape" parent="."]
shape = SubResource( 1 )
)");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(p.warnings() ==
              std::vector<std::string>{
                  "a.tscn:2:1: warning: files of class Script are kept, without effect",
                  "a.tscn:4:1: warning: resources of class BoxShape are kept, without effect",
                  "a.tscn:10:1: warning: nodes of class CollisionShape are kept, without effect"});
        CHECK(root->get("speed") == Variant(3.5));
        const auto* shape =
            dynamic_cast<const MissingResource*>(root->get_node("B")->get("shape").to_object());
        REQUIRE(shape != nullptr);
        CHECK(shape->class_name().str() == "BoxShape");
        CHECK(shape->get("extents") == Variant(glm::vec3(1)));
    }

    TEST_CASE("an unknown property is warned about once for its class and kept") {
        TestProject p;
        p.write("a.tscn", scene_of("[sub_resource type=\"CubeMesh\" id=1]\nsiez = 1\n[sub_resource "
                                   "type=\"CubeMesh\" id=2]\nsiez = 2\n",
                                   "meshes = 3\n__meta__ = {}\n_import_path = NodePath(\".\")"));
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(p.warnings() ==
              std::vector<std::string>{
                  "a.tscn:3:1: warning: CubeMesh has no property \"siez\": kept, without effect",
                  "a.tscn:8:1: warning: MeshInstance has no property \"meshes\": kept, without effect"});
        CHECK(root->get("meshes") == Variant(3));
    }

    TEST_CASE("a value of a wrong type is an error with the types") {
        TestProject p;
        CHECK(p.outcome(scene_of(sub("SpatialMaterial", "roughness = \"high\""))) ==
              "a.tscn:3:13: error: SpatialMaterial.roughness: expected float, found String");
        CHECK(p.outcome(scene_of(sub("CubeMesh", "size = Vector2( 1, 1 )"))) ==
              "a.tscn:3:8: error: CubeMesh.size: expected Vector3, found Vector2");
        CHECK(p.outcome(scene_of("[sub_resource type=\"CubeMesh\" id=2]\n" +
                                 sub("CubeMesh", "material = SubResource( 2 )"))) ==
              "a.tscn:4:12: error: CubeMesh.material: expected a Material, found a CubeMesh");
        CHECK(p.outcome(scene_of("", "mesh = 5")) ==
              "a.tscn:4:8: error: MeshInstance.mesh: expected a Mesh, found int");
        CHECK(p.outcome(scene_of("", "transform = \"up\"")) ==
              "a.tscn:4:13: error: MeshInstance.transform: expected Transform, found String");
        CHECK(p.outcome(scene_of("", "transform = Vector3( 1, 2 )")).substr(0, 20) == "a.tscn:4:27: error: ");
    }

    TEST_CASE("numbers and bools convert into each other as in Godot") {
        TestProject p;
        p.write("a.tscn", scene_of(sub("CubeMesh", "subdivide_width = 1.7\nflip_faces = 1"),
                                   "mesh = SubResource( 1 )\nlayers = 3.9\nvisible = 0"));
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        const Ref<CubeMesh> mesh = dynamic_cast<const MeshInstance&>(*root).mesh().cast<CubeMesh>();
        CHECK(mesh->shape().subdivide_width == 1);
        CHECK(mesh->flip_faces());
        CHECK(root->get("layers") == Variant(3));
        CHECK(root->get("visible") == Variant(false));
    }

    TEST_CASE("null for a number is a warning, a number out of range too, and the property keeps its value") {
        TestProject p;
        CHECK(p.outcome(scene_of(sub("SpatialMaterial",
                                     "roughness = null\nparams_cull_mode = 9\nrender_priority = 1000"))) ==
              "loaded");
        CHECK(p.warnings() ==
              std::vector<std::string>{
                  "a.tscn:3:13: warning: SpatialMaterial.roughness: expected float, found null",
                  "a.tscn:4:20: warning: SpatialMaterial.params_cull_mode: expected a value in range, found "
                  "9, which is left out",
                  "a.tscn:5:19: warning: SpatialMaterial.render_priority: expected a value in range, found "
                  "1000, which is left out"});
    }

    TEST_CASE("a number that is not finite as the property holds it is a warning, and the property keeps its "
              "value") {
        TestProject p;
        p.write("a.tscn", R"([gd_scene format=2]
[node name="A" type="OmniLight"]
transform = Transform( nan, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 )
light_energy = 1e300
omni_range = inf
light_color = Color( 1, inf, 0, 1 )
omni_attenuation = 1e30
shadow_bias = 1e-300
unknown = inf
)");
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(root->get("transform") == Variant(Transform()));
        CHECK(root->get("light_energy") == Variant(1.0));
        CHECK(root->get("omni_range") == Variant(5.0));
        CHECK(root->get("light_color") == Variant(Color{1, 1, 1, 1}));
        CHECK(root->get("omni_attenuation") == Variant(1e30f));
        CHECK(root->get("shadow_bias") == Variant(0.0));
        const std::vector<std::string> warnings = p.warnings();
        REQUIRE(warnings.size() == 5);
        CHECK(warnings[0] == "a.tscn:3:13: warning: OmniLight.transform: expected a value in range, found "
                             "nan, 0, 0, 0, 1, 0, 0, 0, 1 - 0, 0, 0, which is left out");
        CHECK(warnings[2] ==
              "a.tscn:5:14: warning: OmniLight.omni_range: expected a value in range, found inf, "
              "which is left out");
    }

    TEST_CASE(
        "a resource of a class that we do not have in the place of one of ours is a warning, and is kept") {
        TestProject p;
        p.write("a.tscn", scene_of("[sub_resource type=\"GradientTexture\" id=2]\n" +
                                       sub("SpatialMaterial", "albedo_texture = SubResource( 2 )"),
                                   "material_override = SubResource( 1 )"));
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        const Ref<Material> material = dynamic_cast<const MeshInstance&>(*root).material_override();
        REQUIRE(material);
        REQUIRE(material->extra_properties().size() == 1);
        CHECK(material->extra_properties()[0].name.str() == "albedo_texture");
        CHECK(p.outcome(scene_of(sub(
                  "ArrayMesh",
                  "surfaces/0 = { \"aabb\": AABB( 0, 0, 0, 1, 1, 1 ), \"array_data\": PoolByteArray(  ), "
                  "\"array_index_data\": PoolByteArray(  ), \"format\": 97599, \"index_count\": 1000000000, "
                  "\"primitive\": 4, \"vertex_count\": 1000000000 }"))) ==
              "a.tscn:3:14: error: ArrayMesh.surfaces/0: surface: expected 1000000000 vertices of 32 bytes, "
              "found 0 "
              "bytes");
        CHECK(p.outcome(scene_of(sub("Image", "data = { \"width\": 1000000000, \"height\": 1, \"format\": "
                                              "\"RGBA8\", \"data\": PoolByteArray(  ) }"))) ==
              "a.tscn:3:8: error: Image.data: expected \"width\" and \"height\" from 1 to 16384, found "
              "1000000000 and 1");
        CHECK(p.outcome(scene_of(sub("PlaneMesh", "subdivide_depth = 1000000000"))) ==
              "a.tscn:3:19: error: PlaneMesh.subdivide_depth: expected a shape of at most 4000000 vertices, "
              "found 2000000004");
        CHECK(p.outcome(scene_of(sub("GIProbeData", "dynamic_data = PoolIntArray( 0, 7, 64, 64, 64, "
                                                    "1000000000, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 )")))
                  .substr(0, 46) == "a.tscn:3:16: error: GIProbeData.dynamic_data: ");
        const std::string deep(100000, '[');
        CHECK(p.outcome(scene_of("", "a = " + deep)).substr(0, 9) == "a.tscn:4:");
    }

    TEST_CASE("only resources that have objects can be sub resources") {
        TestProject p;
        CHECK(p.outcome(scene_of(sub("Spatial", ""))) ==
              "a.tscn:2:1: error: expected the class of a resource, found \"Spatial\"");
        CHECK(p.outcome(scene_of(sub("Mesh", ""))) ==
              "a.tscn:2:1: error: expected a class that has objects, found the abstract \"Mesh\"");
    }

    TEST_CASE("a resource file is no scene") {
        TestProject p;
        p.write("a.tscn", "[gd_resource type=\"CubeMesh\" format=2]\n[resource]\n");
        CHECK(p.load() == nullptr);
        CHECK(p.error() == "a.tscn:1:1: error: expected a scene, found a resource of class CubeMesh");
        CHECK(p.load("none.tscn") == nullptr);
        CHECK(p.error() == "none.tscn: error: expected a file, found none");
    }

    TEST_CASE("an importer reads the files of its suffix, others of that kind are left out with a warning") {
        TestProject p;
        p.write("ball.glb", "glTF");
        const std::string scene =
            "[gd_scene]\n[ext_resource path=\"res://ball.glb\" type=\"PackedScene\" id=1]\n"
            "[node name=\"A\" type=\"Spatial\"]\n[node name=\"B\" parent=\".\" instance=ExtResource( 1 )]\n"
            "[node name=\"C\" type=\"Spatial\" parent=\"B\"]\n[node name=\"D\" type=\"Spatial\" "
            "parent=\".\"]\n";
        p.write("a.tscn", scene);
        const std::unique_ptr<Node> root = p.load();
        REQUIRE_MESSAGE(root != nullptr, p.error());
        CHECK(root->children().size() == 1);
        CHECK(p.warnings() ==
              std::vector<std::string>{
                  "a.tscn:2:1: warning: res://ball.glb: files of this kind are kept, without effect",
                  "a.tscn:4:1: warning: \"./B\" is left out: its scene res://ball.glb could not be read"});

        ResourceLoader loader(ProjectPaths::containing(p.file("a.tscn")), p.diagnostics());
        loader.add_importer("glb", [](const std::filesystem::path&, Diagnostics&) -> Expected<Ref<Resource>> {
            return Error{ErrorCode::ParseError, "expected a glTF header, found none"};
        });
        const Expected<Ref<PackedScene>> packed = loader.load_scene(p.file("a.tscn"));
        REQUIRE(!packed.has_value());
        CHECK(packed.error().message == "res://ball.glb: expected a glTF header, found none");
    }
}
