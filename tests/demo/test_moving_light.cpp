#include "demo/offscreen_server.h"
#include "demo/spinning_lamp_scene.h"

#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"
#include "scene/register_types.h"

#include "core/image.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>
#include <vector>

// The small, fast part of tests/truth/moving_light.cpp: what holds however long frames take.
namespace {

using namespace cl;

const glm::vec3 kHere_m{0.0f, 3.0f, 0.3f}, kThere_m{1.2f, 2.2f, 0.3f};

/// The room of the lamp that swings, with a lamp that does not, and its pictures.
class Room {
public:
    explicit Room(std::unique_ptr<VisualServer> server) : tree_(std::move(server), {.size = {96, 54}}) {
        std::unique_ptr<scene::Node> room = demo::make_spinning_lamp_scene(scene::GIProbeSubdiv::Cells64);
        lamp = room->get_node_as<scene::OmniLight>("Lamp");
        lamp->set_script_instance(nullptr);
        lamp->set_translation(kHere_m);
        REQUIRE(room->get_node_as<scene::GIProbe>("Probe")->bake().has_value());
        REQUIRE(tree_.set_scene(std::move(room)).ok());
    }
    void frame() {
        tree_.step(1.0 / 60.0);
        REQUIRE(tree_.draw().ok());
    }
    /// Frames until nothing is left to do; at most so many.
    void frames_until_rest(int most) {
        for (int i = 0; i < most; ++i) {
            frame();
            if (tree_.server()->is_settled()) {
                frame(); // what came in last is drawn by the next one
                return;
            }
        }
    }
    std::vector<uint8_t> settled() {
        tree_.step(1.0 / 60.0);
        REQUIRE(tree_.draw_settled().ok());
        return shown();
    }
    std::vector<uint8_t> shown() {
        const Expected<Image> picture =
            tree_.server()->viewport_read(tree_.world().viewport(), TargetFormat::Srgb8);
        REQUIRE(picture.has_value());
        return picture->data;
    }

    scene::OmniLight* lamp = nullptr; ///< the tree's

private:
    scene::SceneTree tree_;
};

} // namespace

TEST_SUITE("demo/moving_light") {
    TEST_CASE("[gl] a lamp that moves or is switched leaves nothing behind in the picture, to the byte") {
        scene::register_scene_types(ClassRegistry::instance());
        Expected<std::unique_ptr<VisualServer>> server = demo::make_offscreen_server();
        if (!server) {
            MESSAGE("skipped: " << server.error().to_string());
            return;
        }
        Room room(std::move(*server));
        const std::vector<uint8_t> here = room.settled();
        room.frame();
        CHECK(room.shown() == here);

        room.lamp->set_translation(kThere_m);
        room.frames_until_rest(10'000);
        const std::vector<uint8_t> there = room.shown();
        CHECK(there != here);
        CHECK(room.settled() == there);

        for (int i = 0; i < 10; ++i) {
            room.lamp->set_visible(i % 2 == 1);
            room.frame();
        }
        room.frames_until_rest(10'000);
        CHECK(room.shown() == there);
        room.lamp->set_translation(kHere_m);
        CHECK(room.settled() == here);
    }
}
