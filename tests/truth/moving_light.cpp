// Pictures of a room while its lamp moves and is switched, sixty steps a second, as a game shows them: what
// tests/truth/laws.py holds against the pictures of the same lamp at rest.
//
// usage: moving_light FOLDER
// Writes jump_K.png (K frames after the lamp went elsewhere), swing_K.png (frames of a lamp that never
// rests), each with NAME_settled.png; still_0.png and still_1.png, two frames in a row of a room at rest; and
// switched.png, what a hundred times off and on leave of still_0.png.
#include "demo/offscreen_server.h"
#include "demo/spinning_lamp_scene.h"

#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"
#include "scene/register_types.h"

#include "core/image.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <thread>

namespace {

using namespace cl;

constexpr int kFramesAfterJump = 12, kSwingFrames = 150, kSwingWarmUp = 110, kSwitches = 100;
constexpr double kStep_s = 1.0 / 60.0;
const glm::vec3 kHere_m{0.0f, 3.0f, 0.3f}, kThere_m{1.2f, 2.2f, 0.3f};

/// The room and the pictures taken of it. The first error stays; what follows it does nothing.
class Shoot {
public:
    explicit Shoot(std::unique_ptr<VisualServer> server) : tree_(std::move(server), {.size = {480, 270}}) {
        std::unique_ptr<scene::Node> room = demo::make_spinning_lamp_scene(scene::GIProbeSubdiv::Cells128);
        lamp_ = room->get_node_as<scene::OmniLight>("Lamp");
        lamp_->set_script_instance(nullptr);
        const auto baked = room->get_node_as<scene::GIProbe>("Probe")->bake();
        status_ = baked ? tree_.set_scene(std::move(room)) : Status(baked.error());
    }

    void put_lamp(const glm::vec3& at_m) { lamp_->set_translation(at_m); }
    void show_lamp(bool shown) { lamp_->set_visible(shown); }
    /// A frame of a game: it is not drawn before its time.
    void step() {
        std::this_thread::sleep_until(next_frame_);
        next_frame_ = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::nanoseconds>(
                                                             std::chrono::duration<double>(kStep_s));
        tree_.step(kStep_s);
        note(tree_.draw());
    }
    void settle() {
        tree_.step(kStep_s);
        note(tree_.draw_settled());
    }
    void take(const std::string& name) {
        Expected<Image> picture =
            tree_.server()->viewport_read(tree_.world().viewport(), TargetFormat::Srgb8);
        note(picture ? Status{} : Status(picture.error()));
        if (picture) {
            taken_.emplace(name, std::move(*picture));
        }
    }
    /// Only now: files take longer than frames.
    Status save(const std::filesystem::path& folder) {
        for (const auto& [name, picture] : taken_) {
            note(save_image(picture, folder / (name + ".png")));
        }
        return status_;
    }

private:
    void note(const Status& status) {
        if (status_.ok() && !status.ok()) {
            status_ = status;
        }
    }

    scene::SceneTree tree_;
    scene::OmniLight* lamp_ = nullptr; ///< the tree's
    Status status_;
    std::map<std::string, Image> taken_;
    std::chrono::steady_clock::time_point next_frame_ = std::chrono::steady_clock::now();
};

std::string numbered(const char* name, int number) {
    return std::string(name) + (number < 10 ? "_0" : "_") + std::to_string(number);
}

void rest(Shoot& shoot) {
    shoot.put_lamp(kHere_m);
    shoot.settle();
    shoot.take("still_0");
    shoot.step();
    shoot.take("still_1");
}

void jump(Shoot& shoot) {
    shoot.put_lamp(kThere_m);
    for (int i = 1; i <= kFramesAfterJump; ++i) {
        shoot.step();
        shoot.take(numbered("jump", i));
    }
    shoot.settle();
    shoot.take("jump_settled");
}

glm::vec3 swung(int frame) {
    return kHere_m + glm::vec3(1.4f * std::sin(0.024f * float(frame)), 0.0f, 0.0f); // 2 m/s in the middle
}

void swing(Shoot& shoot) {
    for (int i = 0; i < kSwingFrames; ++i) {
        shoot.put_lamp(swung(i));
        shoot.step();
        if (i >= kSwingWarmUp) {
            shoot.take(numbered("swing", i));
        }
    }
    for (int i = kSwingWarmUp; i < kSwingFrames; ++i) {
        shoot.put_lamp(swung(i));
        shoot.settle();
        shoot.take(numbered("swing", i) + "_settled");
    }
}

void switch_on_and_off(Shoot& shoot) {
    shoot.put_lamp(kHere_m);
    for (int i = 0; i < 2 * kSwitches; ++i) {
        shoot.show_lamp(i % 2 == 1);
        shoot.step();
    }
    shoot.settle();
    shoot.take("switched");
}

} // namespace

int main(int argc, char** argv) {
    scene::register_scene_types(ClassRegistry::instance());
    Expected<std::unique_ptr<VisualServer>> server = demo::make_offscreen_server();
    if (!server) {
        std::fprintf(stderr, "%s\n", server.error().to_string().c_str());
        return 1;
    }
    Shoot shoot(std::move(*server));
    rest(shoot);
    jump(shoot);
    swing(shoot);
    switch_on_and_off(shoot);
    const Status status = shoot.save(argc > 1 ? argv[1] : ".");
    if (!status) {
        std::fprintf(stderr, "%s\n", status.error().to_string().c_str());
    }
    return status ? 0 : 1;
}
