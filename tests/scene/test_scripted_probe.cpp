#include "demo/spinning_lamp_scene.h"
#include "tests/scene/scene_fixture.h"

#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"

#include "drivers/dummy/dummy_rasterizer.h"

#include "servers/rasterizer_checked.h"
#include "servers/visual_server.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

using namespace cl;
using namespace cl::scene;
using cl::dummy::CallKind;
using cl::tests::register_types;

namespace {

/// The example's room in a tree that is drawn by nobody and recorded.
class ScriptedProbe {
public:
    ScriptedProbe() {
        register_types();
        auto dummy = std::make_unique<dummy::DummyRasterizer>();
        recorder = dummy.get();
        tree = std::make_unique<SceneTree>(
            std::make_unique<VisualServer>(std::make_unique<RasterizerChecked>(std::move(dummy))));
        RenderSettings settings;
        settings.gi_mode = GIMode::Cones; // the volumes are what these tests look at
        tree->server()->set_settings(settings);
        std::unique_ptr<Node> room = demo::make_spinning_lamp_scene(GIProbeSubdiv::Cells64);
        REQUIRE(room->get_node_as<GIProbe>("Probe")->bake().has_value());
        REQUIRE(tree->set_scene(std::move(room)).ok());
        REQUIRE(tree->draw_settled().ok());
    }
    template <typename T>
    T& node(std::string_view path) const {
        T* found = tree->scene()->get_node_as<T>(path);
        REQUIRE(found != nullptr);
        return *found;
    }
    /// Texels of the finest level of the probe's volume.
    [[nodiscard]] std::vector<uint8_t> texels() const {
        REQUIRE(recorder->last_frame() != nullptr);
        REQUIRE(recorder->last_frame()->gi_probes.size() == 1);
        const std::span<const uint8_t> t =
            recorder->volume_texels(recorder->last_frame()->gi_probes[0].volume, 0);
        return {t.begin(), t.end()};
    }

    dummy::DummyRasterizer* recorder = nullptr;
    std::unique_ptr<SceneTree> tree;
};

/// Sum of the red channel on the left (x below the middle) and right half of an n^3 volume.
std::pair<int64_t, int64_t> red_left_right(const std::vector<uint8_t>& rgba8, int n) {
    std::pair<int64_t, int64_t> sums{0, 0};
    for (size_t i = 0; i < rgba8.size() / 4; ++i) {
        const bool left = static_cast<int>(i % static_cast<size_t>(n)) < n / 2;
        (left ? sums.first : sums.second) += rgba8[4 * i];
    }
    return sums;
}

} // namespace

TEST_SUITE("scene/scripted_probe") {
    TEST_CASE("a scene made of nodes reaches the rasteriser: walls, lamp, camera and a lit probe") {
        const ScriptedProbe s;
        const dummy::RecordedFrame& frame = *s.recorder->last_frame();
        CHECK(frame.opaque.size() == 6);
        REQUIRE(frame.lights.size() == 1);
        CHECK(frame.light_descs[0].energy == 1.2f);
        CHECK(frame.lights[0].world_from_light.origin == glm::vec3(0.0f, 3.0f, 0.3f));
        CHECK(frame.frame.camera.fov_deg == 45.0f);
        REQUIRE(frame.gi_probes.size() == 1);
        CHECK(!frame.gi_probes[0].blend_ambient); // an interior
        for (const DrawItem& item : frame.opaque) {
            CHECK(item.receives_baked_light);
            CHECK(item.gi_probes[0] == 0);
        }
        const std::vector<uint8_t> texels = s.texels();
        CHECK(std::accumulate(texels.begin(), texels.end(), int64_t{0}) > 0);
    }

    TEST_CASE("the script swings the lamp, and the light in the probe's volume swings with it") {
        const ScriptedProbe s;
        s.tree->step(0.5); // a quarter of the period: as far to the right as it goes
        CHECK(s.node<OmniLight>("Lamp").translation().x == doctest::Approx(1.4));
        REQUIRE(s.tree->draw_settled().ok());
        CHECK(s.recorder->last_frame()->lights[0].world_from_light.origin.x == doctest::Approx(1.4));
        const auto right = red_left_right(s.texels(), 64);
        s.tree->step(1.0); // half a period on: as far to the left
        REQUIRE(s.tree->draw_settled().ok());
        const auto left = red_left_right(s.texels(), 64);
        CHECK(left.first * right.second > right.first * left.second); // a greater share on the left
    }

    TEST_CASE("the script switches the probe's propagation, which lights its coarse levels anew") {
        const ScriptedProbe s;
        CHECK(s.node<GIProbe>("Probe").data()->data().propagation == 0.7f);
        s.tree->step(1.25); // past half of the period
        CHECK(s.node<GIProbe>("Probe").propagation() == 0.35f);
        CHECK(s.node<GIProbe>("Probe").data()->data().propagation == 0.35f);
        REQUIRE(s.tree->draw_settled().ok());
        const RID volume = s.recorder->last_frame()->gi_probes[0].volume;
        const auto coarse_sum = [&] {
            const std::span<const uint8_t> t = s.recorder->volume_texels(volume, 3);
            return std::accumulate(t.begin(), t.end(), int64_t{0});
        };
        const int64_t low = coarse_sum();
        s.node<GIProbe>("Probe").set_propagation(1.0f); // light no longer fades with empty neighbours
        REQUIRE(s.tree->draw_settled().ok());
        CHECK(coarse_sum() > low);
    }

    TEST_CASE("when nothing changes, nothing is uploaded") {
        const ScriptedProbe s;
        s.tree->step(0.5);
        REQUIRE(s.tree->draw_settled().ok());
        s.recorder->forget_calls();
        s.tree->set_paused(true);
        for (int i = 0; i < 3; ++i) {
            s.tree->step(0.5);
            REQUIRE(s.tree->draw_settled().ok());
        }
        CHECK(s.recorder->count(CallKind::VolumeUpload) == 0);
        CHECK(s.recorder->count(CallKind::MeshCreate) == 0);
        CHECK(s.recorder->count(CallKind::Draw) == 3);
    }

    TEST_CASE("a tree gives back all that it made in the rasteriser") {
        const ScriptedProbe s;
        CHECK(s.recorder->live().meshes == 6);
        CHECK(s.recorder->live().volumes == 1);
        Node& scene = *s.tree->scene();
        scene.queue_free();
        s.tree->step(0.1);
        CHECK(s.tree->scene() == nullptr);
        REQUIRE(s.tree->draw_settled().ok());
        CHECK(s.recorder->live().meshes == 0);
        CHECK(s.recorder->live().volumes == 0);
        CHECK(s.recorder->last_frame()->opaque.empty());
        CHECK(s.recorder->last_frame()->lights.empty());
        CHECK(s.tree->server()->stats().instances == 0);
    }
}
