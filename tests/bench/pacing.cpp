// Frames of a room whose lamp moves on every one of them: how long the longest takes.
//
// usage: pacing [FRAMES]
// A frame is a step of the tree and its picture, as a game would run them. In turn with each, one without GI
// is drawn: a machine that others use is slower for spells, and both are. Printed are for each GI mode the
// frames' length, and what it is to that of the frames without GI before and after: median, and to it
// percentiles, the longest, and the median change from a frame to the next; how many took more than 1.5 times
// the median; and how many relights came in.
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
    std::vector<double> control_ms; ///< of frames without GI, drawn in turn with them
    int relights = 0;               ///< that took another time than the one before: two alike count as one
};

Expected<std::unique_ptr<scene::SceneTree>> make_tree(GIMode mode) {
    Expected<std::unique_ptr<VisualServer>> server = demo::make_offscreen_server();
    if (!server) {
        return server.error();
    }
    RenderSettings settings;
    settings.gi_mode = mode;
    (*server)->set_settings(settings);
    auto tree =
        std::make_unique<scene::SceneTree>(std::move(*server), scene::ViewportOptions{.size = {480, 270}});
    std::unique_ptr<scene::Node> room = demo::make_spinning_lamp_scene(scene::GIProbeSubdiv::Cells128);
    if (const auto baked = room->get_node_as<scene::GIProbe>("Probe")->bake(); !baked) {
        return baked.error();
    }
    if (Status shown = tree->set_scene(std::move(room)); !shown) {
        return shown.error();
    }
    if (Status drawn = tree->draw_settled(); !drawn) {
        return drawn.error();
    }
    return tree;
}

/// Length of a step and its picture [ms].
Expected<double> frame_ms(scene::SceneTree& tree) {
    const auto begin = std::chrono::steady_clock::now();
    tree.step(1.0 / 60.0);
    if (Status drawn = tree.draw(); !drawn) {
        return drawn.error();
    }
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

Expected<Paces> run(GIMode mode, int frames) {
    const Expected<std::unique_ptr<scene::SceneTree>> tree = make_tree(mode),
                                                      control = make_tree(GIMode::Off);
    for (const auto* made : {&tree, &control}) {
        if (!*made) {
            return made->error();
        }
    }
    Paces paces;
    double last_relight_ms = 0.0;
    for (int i = -kWarmUp; i < frames; ++i) {
        const Expected<double> frame = frame_ms(**tree), other = frame_ms(**control);
        for (const auto* drawn : {&frame, &other}) {
            if (!*drawn) {
                return drawn->error();
            }
        }
        const double relight_ms = (*tree)->server()->stats().relight_ms;
        if (i >= 0) {
            paces.frames_ms.push_back(*frame);
            paces.control_ms.push_back(*other);
            paces.relights += relight_ms != last_relight_ms ? 1 : 0;
        }
        last_relight_ms = relight_ms;
    }
    return paces;
}

/// Median change from a frame to the next: what a slow spell of the machine, which lasts for many frames,
/// tells little in.
double judder_of(const std::vector<double>& frames) {
    std::vector<double> steps{0.0};
    for (size_t i = 1; i < frames.size(); ++i) {
        steps.push_back(std::abs(frames[i] - frames[i - 1]));
    }
    std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
    return steps[steps.size() / 2];
}

double part_of(const std::vector<double>& sorted, double part) {
    return sorted[size_t(part * double(sorted.size() - 1))];
}

/// A line of figures [unit], to the median of which the last ones are.
void print(const char* name, const char* what, std::vector<double> f) {
    const double judder = judder_of(f);
    std::sort(f.begin(), f.end());
    const double median = part_of(f, 0.5);
    const auto over = f.end() - std::upper_bound(f.begin(), f.end(), 1.5 * median);
    std::printf("%-6s %-16s median %6.2f  95%% %.2f x  99%% %.2f x  longest %.2f x  frame to frame %.2f x  "
                "over 1.5 x: %d of %d\n",
                name, what, median, part_of(f, 0.95) / median, part_of(f, 0.99) / median, f.back() / median,
                judder / median, int(over), int(f.size()));
}

void print(const char* name, const Paces& paces) {
    print(name, "[ms]", paces.frames_ms);
    std::vector<double> ratios = paces.frames_ms;
    for (size_t i = 0; i < ratios.size(); ++i) {
        const double before = paces.control_ms[i > 0 ? i - 1 : 0];
        ratios[i] /= 0.5 * (before + paces.control_ms[i]);
    }
    print(name, "[frames, no GI]", ratios);
    std::printf("%-6s relights %d\n", name, paces.relights);
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
