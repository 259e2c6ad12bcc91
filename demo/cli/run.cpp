#include "demo/cli/commands.h"
#include "demo/cli/figures.h"
#include "demo/cli/fly_camera.h"
#include "demo/cli/scene_loading.h"
#include "demo/cli/stage.h"

#include "scene/3d/camera.h"
#include "scene/3d/world.h"

#include "servers/visual_server.h"

#include "core/io/log.h"

#include <fmt/format.h>

#include <algorithm>

namespace cl::demo {

namespace {

constexpr double kIdleWait_s = 1.0 / 144.0; // so that what moves after a while starts in time
constexpr double kMaxStep_s = 0.1;          // after a stall the camera must not jump through the scene

/// Puts the mean time of a frame in the title: twice a second, and when the picture comes to rest.
class FrameTimeTitle {
public:
    void frame(drivers::Window& window, double frame_ms) {
        sum_ms_ += frame_ms;
        ++frames_;
        if (sum_ms_ >= 500.0) {
            show(window);
        }
    }
    /// Nothing if no frame was timed since it was shown last.
    void show(drivers::Window& window) {
        if (frames_ == 0) {
            return;
        }
        const double mean_ms = sum_ms_ / frames_;
        window.set_title(fmt::format("Conelight - {:.1f} ms ({:.0f} fps)", mean_ms, 1000.0 / mean_ms));
        log_debug(fmt::format("frame {:.1f} ms", mean_ms));
        sum_ms_ = 0.0;
        frames_ = 0;
    }

private:
    double sum_ms_ = 0.0;
    int frames_ = 0;
};

/// Frames until Esc, the window's close button or --frames. Where nothing changes, nothing is drawn and the
/// machine sleeps; with --frames, which is for measuring, all are.
Status run_frames(Stage& stage, const Options& options, std::vector<double>& times_ms) {
    drivers::Window& window = *stage.window();
    scene::Camera& camera = *stage.tree().world().current_camera();
    FlyCamera fly(camera.global_transform());
    FrameTimeTitle title;
    stage.tree().step(0.0);
    stage.server().settle(); // the first frame is not dark
    Stopwatch frame;
    bool idle = false;
    for (int64_t n = 0; !options.frames || n < *options.frames; ++n) {
        const drivers::InputState& input = window.poll(idle ? kIdleWait_s : 0.0);
        if (input.close_requested || input.was_pressed(drivers::Key::Escape)) {
            break;
        }
        const double frame_ms = frame.elapsed_ms();
        frame = Stopwatch();
        if (n > 0 && !idle) {
            times_ms.push_back(frame_ms);
            title.frame(window, frame_ms);
        }
        const double delta_s = std::min(frame_ms * 1e-3, kMaxStep_s);
        if (fly.update(input, static_cast<float>(delta_s))) {
            camera.set_global_transform(fly.world_from_camera());
        }
        const glm::ivec2 size = stage.window_size();
        if (size.x > 0 && size.y > 0 && size != stage.tree().world().viewport_size()) {
            stage.tree().world().set_viewport_size(size);
        }
        stage.tree().step(delta_s);
        idle = !options.frames && !input.uncovered && !stage.tree().has_changed();
        if (idle) {
            title.show(window);
            continue;
        }
        if (Status drawn = stage.tree().draw(); !drawn) {
            return drawn;
        }
        stage.present();
    }
    return {};
}

} // namespace

int run_live(const Options& options) {
    Diagnostics diagnostics;
    Expected<LoadedScene> loaded = load_scene(options, diagnostics);
    if (!loaded) {
        return fail(loaded.error());
    }
    print_warnings(diagnostics, options.verbosity);
    Options windowed = options;
    windowed.driver = "window";
    Expected<std::unique_ptr<Stage>> stage = Stage::open(windowed, loaded->settings);
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
    if (const Status shown = (*stage)->show(std::move(loaded->root), options); !shown) {
        return fail(shown.error());
    }
    std::vector<double> times_ms;
    if (const Status ran = run_frames(**stage, options, times_ms); !ran) {
        return fail(ran.error());
    }
    if (options.stats_file.empty()) {
        return kDone;
    }
    if (!times_ms.empty()) {
        std::nth_element(times_ms.begin(), times_ms.begin() + times_ms.size() / 2, times_ms.end());
        figures.frame_ms = times_ms[times_ms.size() / 2];
    }
    (*stage)->describe(figures);
    figures.scene = options.input.filename().string();
    figures.gi = gi_name(options.gi_mode);
    figures.warnings = diagnostics.warnings().size();
    const Status written = write_json(to_json(figures), options.stats_file);
    return written ? kDone : fail(written.error());
}

} // namespace cl::demo
