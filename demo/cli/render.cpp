#include "demo/cli/commands.h"
#include "demo/cli/figures.h"
#include "demo/cli/pictures.h"
#include "demo/cli/scene_loading.h"
#include "demo/cli/stage.h"

#include "servers/visual_server.h"

#include "core/io/log.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace cl::demo {

namespace {

constexpr double kFrame_s = 1.0 / 60.0;
constexpr int kTimedFrames =
    3; // for --stats: the median of an odd few is enough, one frame may take a second

Status draw_frames(Stage& stage, const Options& options) {
    for (int frame = 0; frame < options.frames.value_or(1); ++frame) {
        stage.tree().step(kFrame_s);
        stage.server().settle(); // what is drawn has all its light: pictures do not depend on the frame count
        if (Status drawn = stage.tree().draw(); !drawn) {
            return drawn;
        }
    }
    return {};
}

Status make_pictures(Stage& stage, std::unique_ptr<scene::Node> root, const Options& options) {
    if (Status shown = stage.show(std::move(root), options); !shown) {
        return shown;
    }
    if (Status drawn = draw_frames(stage, options); !drawn) {
        return drawn;
    }
    return save_pictures(stage.tree(), options.outputs);
}

Expected<double> median_frame_ms(Stage& stage) {
    std::vector<double> times_ms;
    for (int i = 0; i < kTimedFrames; ++i) {
        const Stopwatch frame;
        if (Status drawn = stage.tree().draw(); !drawn) {
            return drawn.error();
        }
        times_ms.push_back(frame.elapsed_ms());
    }
    std::nth_element(times_ms.begin(), times_ms.begin() + kTimedFrames / 2, times_ms.end());
    return times_ms[kTimedFrames / 2];
}

/// Warm frames with and without GI, after the picture is safe.
Status time_frames(Stage& stage, const Options& options, Figures& figures) {
    const Expected<double> with_gi = median_frame_ms(stage);
    if (!with_gi) {
        return with_gi.error();
    }
    figures.frame_ms = *with_gi;
    stage.describe(figures);
    if (options.gi_mode == GIMode::Off) {
        return {};
    }
    stage.set_gi_mode(GIMode::Off);
    (void)stage.tree().draw(); // compiles the shaders of this mode
    const Expected<double> without_gi = median_frame_ms(stage);
    if (!without_gi) {
        return without_gi.error();
    }
    figures.gi_ms = std::max(0.0, *with_gi - *without_gi);
    return {};
}

} // namespace

int run_render(const Options& options) {
    const Stopwatch total;
    if (const Status outputs = check_outputs(options.outputs); !outputs) {
        return fail(outputs.error(), kWrongCommand);
    }
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
    if (options.gi_mode != GIMode::Off) {
        if (Status baked = bake_unbaked_probes(*loaded->root, options, figures); !baked) {
            return fail(baked.error());
        }
    }
    if (const Status made = make_pictures(**stage, std::move(loaded->root), options); !made) {
        return fail(made.error());
    }
    figures.total_ms = total.elapsed_ms();
    for (const std::filesystem::path& path : options.outputs) {
        log_info(fmt::format("{} ({:.0f} ms)", path.string(), *figures.total_ms));
    }
    if (options.stats_file.empty()) {
        return kDone;
    }
    if (const Status timed = time_frames(**stage, options, figures); !timed) {
        return fail(timed.error());
    }
    figures.scene = options.input.filename().string();
    figures.gi = gi_name(options.gi_mode);
    figures.warnings = diagnostics.warnings().size();
    const Status written = write_json(to_json(figures), options.stats_file);
    return written ? kDone : fail(written.error());
}

} // namespace cl::demo
