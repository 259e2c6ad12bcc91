#include "tests/scene/text_scene.h"

#include "scene/io/resource_packer.h"
#include "scene/io/text_writer.h"
#include "scene/resources/gi_probe_data.h"

#include "drivers/dummy/dummy_rasterizer.h"

#include "servers/visual_server.h"

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

/// An octree of the root alone: what an empty bake gives.
gi::ProbeData empty_bake() {
    gi::Octree octree;
    octree.levels = 7;
    octree.dims = glm::ivec3(64);
    gi::Cell root{};
    std::fill(std::begin(root.children), std::end(root.children), gi::kNoChild);
    octree.cells.push_back(root);
    gi::ProbeData data;
    data.bounds = {glm::vec3(-2), glm::vec3(4)};
    data.cell_size_m = 0.0625f;
    data.dynamic_data = gi::encode_octree(octree);
    data.dynamic_range = 4;
    data.bias_cells = 1.5f;
    data.normal_bias_m = 0.0f;
    data.propagation = 0.7f;
    return data;
}

} // namespace

TEST_SUITE("scene/resources/gi_probe_data") {
    TEST_CASE("probe data is saved in the order and with the omissions of a Godot bake") {
        register_types();
        GIProbeData data;
        data.set_data(empty_bake());
        const std::string text = scene_file_text(pack_resource_file(data));
        CHECK(text.substr(0, text.find("PoolIntArray(")) ==
              "[gd_resource type=\"GIProbeData\" format=2]\n\n[resource]\n"
              "bounds = AABB( -2, -2, -2, 4, 4, 4 )\ncell_size = 0.0625\ndynamic_data = ");
        CHECK(text.substr(text.find(" )\ndynamic_range")) ==
              " )\ndynamic_range = 4\nbias = 1.5\nnormal_bias = 0.0\npropagation = 0.7\n");
    }

    TEST_CASE("probe data that is saved and loaded is the same") {
        const cl::tests::TestProject project;
        GIProbeData data;
        data.set_data(empty_bake());
        REQUIRE(save_resource(data, project.file("probe.tres")).ok());
        Diagnostics diagnostics;
        ResourceLoader loader(ProjectPaths::containing(project.file("probe.tres")), diagnostics);
        const Expected<Ref<Resource>> loaded = loader.load(project.file("probe.tres"));
        REQUIRE(loaded.has_value());
        const Ref<GIProbeData> again = loaded->cast<GIProbeData>();
        REQUIRE(again);
        CHECK(again->data().dynamic_data == data.data().dynamic_data);
        CHECK(again->data().bounds == data.data().bounds);
        CHECK(again->data().propagation == data.data().propagation);
        CHECK(again->path() == "res://probe.tres");
        CHECK(diagnostics.warnings().empty());
    }

    TEST_CASE("cells that are not valid are refused with a reason, and the old ones kept") {
        register_types();
        GIProbeData data;
        data.set_data(empty_bake());
        const std::vector<int32_t> before = data.data().dynamic_data;
        std::vector<int32_t> lying = before;
        lying[5] = 1000000000; // cell count
        CHECK(data.set("dynamic_data", PoolIntArray(lying)) == SetResult::Refused);
        CHECK(data.refusal().find("expected") != std::string::npos);
        CHECK(data.data().dynamic_data == before);
        CHECK(data.set("dynamic_data", PoolIntArray(std::vector<int32_t>(20, 1))) == SetResult::Refused);
        CHECK(data.set("dynamic_data", PoolIntArray()) == SetResult::Done);
        CHECK(data.refusal().empty());
    }

    TEST_CASE("the probe keeps its RID through changes") {
        register_types();
        VisualServer server(std::make_unique<dummy::DummyRasterizer>());
        GIProbeData data;
        data.set_data(empty_bake());
        const RID rid = data.rid(server);
        CHECK(rid.is_valid());
        data.set_energy(2.0f);
        data.set_data(empty_bake());
        CHECK(data.rid(server) == rid);
        CHECK(server.gi_probe_set_energy(rid, 1.0f).ok());
    }
}
