#include "tests/scene/text_scene.h"

#include "scene/io/scene_edit.h"
#include "scene/io/text_writer.h"

using namespace cl;
using namespace cl::scene;
using cl::tests::TestProject;

namespace {

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

constexpr std::string_view kScene = R"([gd_scene format=2]

[node name="Room" type="Spatial"]

[node name="Probe" type="GIProbe" parent="."]
extents = Vector3( 2, 2, 2 )
script = null
)";

} // namespace

TEST_SUITE("scene/io/scene_edit") {
    TEST_CASE("embedding adds the resource and the assignment, before the script, and nothing else") {
        TestProject p;
        p.write("a.tscn", kScene);
        const Expected<bool> changed = embed_probe_data(p.file("a.tscn"), "Probe", p.file("data/Probe.tres"));
        REQUIRE(changed.has_value());
        CHECK(*changed);
        CHECK(text_of(p.file("a.tscn")) == R"([gd_scene load_steps=2 format=2]

[ext_resource path="res://data/Probe.tres" type="GIProbeData" id=1]

[node name="Room" type="Spatial"]

[node name="Probe" type="GIProbe" parent="."]
extents = Vector3( 2, 2, 2 )
data = ExtResource( 1 )
script = null
)");
    }

    TEST_CASE("embedding the same again changes nothing") {
        TestProject p;
        p.write("a.tscn", kScene);
        REQUIRE(embed_probe_data(p.file("a.tscn"), "./Probe", p.file("Probe.tres")).has_value());
        const std::string once = text_of(p.file("a.tscn"));
        const Expected<bool> again = embed_probe_data(p.file("a.tscn"), "Probe", p.file("Probe.tres"));
        REQUIRE(again.has_value());
        CHECK(!*again);
        CHECK(text_of(p.file("a.tscn")) == once);
    }

    TEST_CASE("what embedding does not touch keeps its spelling") {
        TestProject p;
        p.write("a.tscn", R"([gd_scene format=2]

[node name="Room" type="Spatial"]
transform = Transform( 1.50, 0, 0, 0, 1e0, 0, 0, 0, 1, .5, +2, 0.1000000001 )
old = NodePath("A:")
text = "two
lines	\u00e4"

[node name="Probe" type="GIProbe" parent="."]
extents = Vector3(2,2,2)
)");
        const std::string before = text_of(p.file("a.tscn"));
        REQUIRE(embed_probe_data(p.file("a.tscn"), "Probe", p.file("p.tres")).has_value());
        std::string expected = before;
        expected.replace(0, std::string("[gd_scene format=2]\n").size(),
                         "[gd_scene load_steps=2 format=2]\n\n"
                         "[ext_resource path=\"res://p.tres\" type=\"GIProbeData\" id=1]\n");
        CHECK(text_of(p.file("a.tscn")) == expected + "data = ExtResource( 1 )\n");
        REQUIRE(embed_probe_data(p.file("a.tscn"), "Probe", p.file("q.tres")).has_value());
        CHECK(text_of(p.file("a.tscn")).find("data = ExtResource( 2 )") != std::string::npos);
    }

    TEST_CASE("another file takes the place of the old one, whose entry goes when nobody uses it") {
        TestProject p;
        p.write("a.tscn", kScene);
        REQUIRE(embed_probe_data(p.file("a.tscn"), "Probe", p.file("old.tres")).has_value());
        REQUIRE(embed_probe_data(p.file("a.tscn"), "Probe", p.file("new.tres")).has_value());
        const std::string text = text_of(p.file("a.tscn"));
        CHECK(text.find("old.tres") == std::string::npos);
        CHECK(text.find("[ext_resource path=\"res://new.tres\" type=\"GIProbeData\" id=2]") !=
              std::string::npos);
        CHECK(text.find("data = ExtResource( 2 )") != std::string::npos);
        CHECK(text.find("load_steps=2") != std::string::npos);
    }

    TEST_CASE("a probe inside an instance gets an entry that overrides it") {
        cl::tests::register_types();
        Diagnostics diagnostics;
        Expected<SceneFile> file = parse_scene_text(kScene, "a.tscn", diagnostics);
        REQUIRE(file.has_value());
        set_node_resource(*file, "House/Hall/Probe", "data", "res://p.tres", "GIProbeData");
        CHECK(file->nodes.back().name == "Probe");
        CHECK(file->nodes.back().parent == "House/Hall");
        CHECK(scene_file_text(*file).find(
                  "[node name=\"Probe\" parent=\"House/Hall\"]\ndata = ExtResource( 1 )") !=
              std::string::npos);
    }
}
