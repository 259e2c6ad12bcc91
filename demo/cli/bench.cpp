#include "demo/cli/commands.h"
#include "demo/cli/figures.h"
#include "demo/cli/scene_loading.h"
#include "demo/cli/stage.h"

#include "scene/3d/gi_probe.h"
#include "scene/3d/light.h"

#include "servers/visual_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <vector>

namespace cl::demo {

namespace {

struct Spread {
    double least = 0.0, median = 0.0, most = 0.0;
};

Spread spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return {values.front(), values[values.size() / 2], values.back()};
}

/// Times `runs` calls after one that is not counted. @return the first error.
Expected<Spread> repeat(int runs, const std::function<Expected<double>()>& run_ms) {
    std::vector<double> times_ms;
    for (int i = 0; i <= runs; ++i) {
        Expected<double> time_ms = run_ms();
        if (!time_ms) {
            return time_ms.error();
        }
        if (i > 0) {
            times_ms.push_back(*time_ms);
        }
    }
    return spread_of(std::move(times_ms));
}

void print_row(const char* name, const std::optional<Spread>& s) {
    if (s) {
        std::cout << fmt::format("{:<10} {:>10.2f} {:>10.2f} {:>10.2f}\n", name, s->least, s->median,
                                 s->most);
    } else {
        std::cout << fmt::format("{:<10} {:>10} {:>10} {:>10}\n", name, "-", "-", "-");
    }
}

scene::Light* first_baked_light(scene::Node& root) {
    scene::Light* found = nullptr;
    root.for_each_in_subtree([&](scene::Node& node) {
        auto* light = dynamic_cast<scene::Light*>(&node);
        if (!found && light && light->is_visible_in_tree() &&
            light->desc().bake_mode != LightBakeMode::Disabled) {
            found = light;
        }
    });
    return found;
}

Expected<Spread> time_bakes(scene::Node& root, const Options& options, Figures& figures) {
    return repeat(options.runs, [&]() -> Expected<double> {
        figures.probes.clear();
        double sum_ms = 0.0;
        for (scene::GIProbe* probe : find_probes(root)) {
            Expected<ProbeFigures> baked = bake_with_progress(root, *probe, options);
            if (!baked) {
                return baked.error();
            }
            sum_ms += *baked->bake_ms;
            figures.probes.push_back(std::move(*baked));
        }
        return sum_ms;
    });
}

/// One light made a little brighter and dimmer in turn, until the new volumes are ready to draw.
Expected<Spread> time_relights(Stage& stage, scene::Light& light, int runs) {
    const float energy = light.desc().energy;
    const auto set_energy = [&light](float value) {
        light.edit([value](LightDesc& d) { d.energy = value; });
    };
    bool brighter = false;
    Expected<Spread> spread = repeat(runs, [&]() -> Expected<double> {
        brighter = !brighter;
        set_energy(brighter ? energy * 1.25f : energy);
        const Stopwatch watch;
        stage.tree().step(0.0);
        stage.server().settle();
        return watch.elapsed_ms();
    });
    set_energy(energy);
    stage.tree().step(0.0);
    stage.server().settle();
    return spread;
}

Expected<Spread> time_frames(Stage& stage, GIMode mode, int runs) {
    stage.set_gi_mode(mode);
    return repeat(runs, [&]() -> Expected<double> {
        const Stopwatch watch;
        if (Status drawn = stage.tree().draw(); !drawn) {
            return drawn.error();
        }
        return watch.elapsed_ms();
    });
}

struct BenchResult {
    std::optional<Spread> bake, relight, frame, frame_off;
};

Expected<BenchResult> measure(Stage& stage, LoadedScene& loaded, const Options& options, Figures& figures) {
    BenchResult result;
    scene::Node& root = *loaded.root;
    if (!find_probes(root).empty()) {
        const Expected<Spread> bakes = time_bakes(root, options, figures);
        if (!bakes) {
            return bakes.error();
        }
        result.bake = *bakes;
    }
    if (Status shown = stage.show(std::move(loaded.root), options); !shown) {
        return shown.error();
    }
    stage.tree().step(0.0);
    stage.server().settle();
    scene::Light* light = first_baked_light(root);
    if (light && !figures.probes.empty()) {
        const Expected<Spread> relights = time_relights(stage, *light, options.runs);
        if (!relights) {
            return relights.error();
        }
        result.relight = *relights;
    }
    const Expected<Spread> off = time_frames(stage, GIMode::Off, options.runs);
    if (!off) {
        return off.error();
    }
    result.frame_off = *off;
    const Expected<Spread> frames = time_frames(stage, options.gi_mode, options.runs);
    if (!frames) {
        return frames.error();
    }
    result.frame = *frames;
    stage.describe(figures);
    return result;
}

} // namespace

int run_bench(const Options& options) {
    const Stopwatch total;
    Diagnostics diagnostics;
    Expected<LoadedScene> loaded = load_scene(options, diagnostics);
    if (!loaded) {
        return fail(loaded.error());
    }
    print_warnings(diagnostics, options.verbosity);
    Expected<std::unique_ptr<Stage>> stage = Stage::open(options, loaded->settings);
    if (!stage) {
        return fail(stage.error(), kNoDriver);
    }
    Figures figures;
    figures.load_ms = loaded->load_ms;
    const Expected<BenchResult> result = measure(**stage, *loaded, options, figures);
    if (!result) {
        return fail(result.error());
    }
    const auto median = [](const std::optional<Spread>& s) {
        return s ? std::optional(s->median) : std::optional<double>();
    };
    figures.scene = options.input.filename().string();
    figures.gi = gi_name(options.gi_mode);
    figures.warnings = diagnostics.warnings().size();
    figures.bake_ms = median(result->bake);
    figures.relight_ms = median(result->relight);
    figures.frame_ms = median(result->frame);
    figures.gi_ms = std::max(0.0, result->frame->median - result->frame_off->median);
    figures.total_ms = total.elapsed_ms();
    if (!options.json_file.empty()) {
        const Status written = write_json(to_json(figures), options.json_file);
        return written ? kDone : fail(written.error());
    }
    std::cout << fmt::format("{:<10} {:>10} {:>10} {:>10}   [ms], {} runs, {} threads, {}\n", "", "least",
                             "median", "most", options.runs, figures.threads, figures.renderer);
    print_row("bake", result->bake);
    print_row("relight", result->relight);
    print_row("frame", result->frame);
    print_row("  no GI", result->frame_off);
    return kDone;
}

} // namespace cl::demo
