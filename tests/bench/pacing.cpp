// Frames of a room whose lamp moves on every one of them: how long the longest takes.
//
// usage: pacing [FRAMES]
// Prints for each GI mode median, percentiles and longest frame, how many took more than 1.5 times the
// median, by how much frames differ from the one before, and how many relights came in. A frame is a step of
// the tree and its picture, as a game would run them.
#include "demo/offscreen_server.h"
#include "demo/spinning_lamp_scene.h"

#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"
#include "scene/register_types.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace cl;

constexpr int kWarmUp = 30;

struct Paces {
    std::vector<double> frames_ms;
    int relights = 0; ///< that took another time than the one before: two alike count as one
};

Expected<Paces> run(GIMode mode, int frames) {
    Expected<std::unique_ptr<VisualServer>> server = demo::make_offscreen_server();
    if (!server) {
        return server.error();
    }
    RenderSettings settings;
    settings.gi_mode = mode;
    (*server)->set_settings(settings);
    scene::SceneTree tree(std::move(*server), {.size = {480, 270}});
    std::unique_ptr<scene::Node> room = demo::make_spinning_lamp_scene(scene::GIProbeSubdiv::Cells128);
    if (const auto baked = room->get_node_as<scene::GIProbe>("Probe")->bake(); !baked) {
        return baked.error();
    }
    if (Status shown = tree.set_scene(std::move(room)); !shown) {
        return shown.error();
    }
    if (Status drawn = tree.draw_settled(); !drawn) {
        return drawn.error();
    }
    Paces paces;
    double last_relight_ms = 0.0;
    for (int i = -kWarmUp; i < frames; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        tree.step(1.0 / 60.0);
        if (Status drawn = tree.draw(); !drawn) {
            return drawn.error();
        }
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
        const double relight_ms = tree.server()->stats().relight_ms;
        if (i >= 0) {
            paces.frames_ms.push_back(took.count());
            paces.relights += relight_ms != last_relight_ms ? 1 : 0;
        }
        last_relight_ms = relight_ms;
    }
    return paces;
}

/// Median change from a frame to the next: what a slow spell of the machine, which lasts for many frames,
/// tells little in.
double judder_ms(const std::vector<double>& frames_ms) {
    std::vector<double> steps{0.0};
    for (size_t i = 1; i < frames_ms.size(); ++i) {
        steps.push_back(std::abs(frames_ms[i] - frames_ms[i - 1]));
    }
    std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
    return steps[steps.size() / 2];
}

void print(const char* name, Paces paces) {
    std::vector<double>& f = paces.frames_ms;
    const double judder = judder_ms(f);
    std::sort(f.begin(), f.end());
    const auto at = [&f](double part) { return f[size_t(part * double(f.size() - 1))]; };
    const double limit_ms = 1.5 * at(0.5);
    const auto over = f.end() - std::upper_bound(f.begin(), f.end(), limit_ms);
    std::printf("%-6s median %6.1f  95%% %6.1f  99%% %6.1f  longest %6.1f ms (%.2f x)  over 1.5 x: %d of %d  "
                "frame to frame %.1f ms  relights %d\n",
                name, at(0.5), at(0.95), at(0.99), f.back(), f.back() / at(0.5), int(over), int(f.size()),
                judder, paces.relights);
}

} // namespace

int main(int argc, char** argv) {
    scene::register_scene_types(ClassRegistry::instance());
    const int frames = std::max(argc > 1 ? std::atoi(argv[1]) : 300, 1);
    const std::pair<const char*, GIMode> modes[] = {
        {"off", GIMode::Off}, {"cones", GIMode::Cones}, {"auto", GIMode::Auto}};
    for (const auto& [name, mode] : modes) {
        const Expected<Paces> paces = run(mode, frames);
        if (!paces) {
            std::fprintf(stderr, "%s\n", paces.error().to_string().c_str());
            return 1;
        }
        print(name, *paces);
    }
    return 0;
}
